// The car of the recording two_lux_parking: two ibeo LUX on its front bumper, 0.25 degrees, up to
// three echoes, ground labelled (mounts as in the recording's own scanner infos).
#pragma once

#include "vehicle/scanners.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicles::two_lux_parking {

// 0.25 degrees: 401 directions in each of the four layers. Sources 10.0.2.101 and 102.
inline constexpr std::array kSensorConfigs{
    vehicle::ibeo_lux("front_left", 0x0A000265, 12002,
                      {.x_m = 3.08, .y_m = 0.28, .z_m = 0.17, .yaw_deg = 30}, 401),
    vehicle::ibeo_lux("front_right", 0x0A000266, 12003,
                      {.x_m = 2.98, .y_m = -0.28, .z_m = 0.17, .yaw_deg = -27}, 401),
};

// The recording's origin is the middle of the rear axle, near the road. Its scanners label ground
// echoes themselves; what they do not label lies between -0.15 and 1.2 m, so the band keeps it all.
inline constexpr vehicle::Description kDescription{
    .name = "two_lux_parking",
    .footprint = {.x_min_m = -0.90, .x_max_m = 2.95, .y_min_m = -0.90, .y_max_m = 0.90},
    .z_min_m = -0.20,
    .z_max_m = 2.00,
};

extern const vehicle::Vehicle kVehicle;  // compiled once, see compiled_vehicle.cpp.in

}  // namespace iog::vehicles::two_lux_parking
