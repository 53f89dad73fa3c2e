// A car with one Velodyne VLP-16 on its roof, as in the street recordings of 2014 (sensor 1.5 m
// above the road by the fit of its ground rings).
#pragma once

#include "vehicle/scanners.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicles::roof_vlp16 {

// From any address: the device broadcasts from whichever it was given.
inline constexpr std::array kSensorConfigs{
    vehicle::velodyne_vlp16("roof", 0, 2368, {.x_m = 0, .y_m = 0, .z_m = 1.50}),
};

inline constexpr vehicle::Description kDescription{
    .name = "roof_vlp16",
    .footprint = {.x_min_m = -2.20, .x_max_m = 2.20, .y_min_m = -0.90, .y_max_m = 0.90},
    .z_min_m = 0.30,
    .z_max_m = 2.20,
    // One turn at 10 Hz takes 100 ms: the scanner's own period instead of the LUX's 40 ms, and a
    // tenth more so that a whole turn closes its frame and the time-out only an interrupted one.
    .frame_period_us = 110'000,
};

extern const vehicle::Vehicle kVehicle;  // compiled once, see compiled_vehicle.cpp.in

}  // namespace iog::vehicles::roof_vlp16
