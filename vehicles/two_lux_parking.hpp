// The car of the recording two_lux_parking: two ibeo LUX on its front bumper, 0.25 degrees, up to
// three echoes, ground labelled (mounts as in the recording's own scanner infos).
#pragma once

#include "vehicle/compile.hpp"

namespace iog::vehicles::two_lux_parking {

constexpr vehicle::SensorConfig lux(std::string_view name, std::uint32_t source_ipv4,
                                    std::uint16_t udp_port, vehicle::MountConfig mount) {
  return {.name = name,
          .format = lidar::Format::kIbeoLux,
          .source_ipv4 = source_ipv4,
          .udp_port = udp_port,
          .mount = mount,
          .range_min_mm = 300,
          .range_max_mm = 50'000,
          .precision_mm = 100,
          .sigma_m = 0.10,
          .scan_width_ticks = 3200,
          .max_points_per_scan = 4 * 401 * 3};
}

inline constexpr std::array kSensorConfigs{
    lux("front_left", 0x0A000265, 12002, {.x_m = 3.08, .y_m = 0.28, .z_m = 0.17, .yaw_deg = 30}),
    lux("front_right", 0x0A000266, 12003, {.x_m = 2.98, .y_m = -0.28, .z_m = 0.17, .yaw_deg = -27}),
};

// The recording's origin is the middle of the rear axle, near the road. Its scanners label ground
// echoes themselves; what they do not label lies between -0.15 and 1.2 m, so the band keeps it all.
inline constexpr vehicle::Description kDescription{
    .name = "two_lux_parking",
    .footprint = {.x_min_m = -0.90, .x_max_m = 2.95, .y_min_m = -0.90, .y_max_m = 0.90},
    .z_min_m = -0.20,
    .z_max_m = 2.00,
};

inline constexpr auto kSensors = vehicle::compile_sensors(kSensorConfigs, kDescription);
inline constexpr vehicle::Vehicle kVehicle = vehicle::compile_vehicle(kDescription, kSensors);

}  // namespace iog::vehicles::two_lux_parking
