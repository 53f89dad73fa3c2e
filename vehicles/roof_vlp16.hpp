// A car with one Velodyne VLP-16 on its roof, as in the street recordings of 2014 (sensor 1.5 m
// above the road by the fit of its ground rings).
#pragma once

#include "vehicle/compile.hpp"

namespace iog::vehicles::roof_vlp16 {

// VLP-16 User Manual 63-9243: accuracy +-3 cm, range up to 100 m. The grid ends 51 m away, and 72 m
// in its corners: nothing beyond can be seen on it.
inline constexpr std::array kSensorConfigs{vehicle::SensorConfig{
    .name = "roof",
    .format = lidar::Format::kVelodyneVlp16,
    .source_ipv4 = 0,
    .udp_port = 2368,
    .mount = {.x_m = 0, .y_m = 0, .z_m = 1.50},
    .range_min_mm = 1'000,
    .range_max_mm = 73'000,
    .precision_mm = 30,
    .sigma_m = 0.03,
    .scan_width_ticks = 36'000,
    .max_points_per_scan = 160 * 384,  // one turn at 10 Hz in dual return mode: 151 packets
}};

inline constexpr vehicle::Description kDescription{
    .name = "roof_vlp16",
    .footprint = {.x_min_m = -2.20, .x_max_m = 2.20, .y_min_m = -0.90, .y_max_m = 0.90},
    .z_min_m = 0.30,
    .z_max_m = 2.20,
    // One turn at 10 Hz takes 100 ms: the scanner's own period instead of the LUX's 40 ms, and a
    // tenth more so that a whole turn closes its frame and the time-out only an interrupted one.
    .frame_period_us = 110'000,
};

inline constexpr auto kSensors = vehicle::compile_sensors(kSensorConfigs, kDescription);
inline constexpr vehicle::Vehicle kVehicle = vehicle::compile_vehicle(kDescription, kSensors);

}  // namespace iog::vehicles::roof_vlp16
