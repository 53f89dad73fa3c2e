// The reference car (docs/model.md section 8; thesis section 4.1): a Renault ZOE with four ibeo
// LUX, three on the front bumper and one on the rear bumper.
//
// The thesis gives the sensors but not their mounts; position and yaw below are those of a car 4.08
// m long and 1.73 m wide whose front scanners overlap by a third.
#pragma once

#include "vehicle/scanners.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicles::reference_car {

// 0.5 degrees: 201 directions in each of the four layers. Sources 10.0.2.101 to 104.
inline constexpr std::array kSensorConfigs{
    vehicle::ibeo_lux("front_left", 0x0A000265, 12002,
                      {.x_m = 1.95, .y_m = 0.60, .z_m = 0.42, .yaw_deg = 40}, 201),
    vehicle::ibeo_lux("front_centre", 0x0A000266, 12003, {.x_m = 2.05, .y_m = 0.00, .z_m = 0.42},
                      201),
    vehicle::ibeo_lux("front_right", 0x0A000267, 12004,
                      {.x_m = 1.95, .y_m = -0.60, .z_m = 0.42, .yaw_deg = -40}, 201),
    vehicle::ibeo_lux("rear_centre", 0x0A000268, 12005,
                      {.x_m = -2.05, .y_m = 0.00, .z_m = 0.42, .yaw_deg = 180}, 201),
};

inline constexpr vehicle::Description kDescription{
    .name = "reference_car",
    .footprint = {.x_min_m = -2.04, .x_max_m = 2.04, .y_min_m = -0.87, .y_max_m = 0.87},
    .z_min_m = 0.20,
    .z_max_m = 2.20,
};

extern const vehicle::Vehicle kVehicle;  // compiled once, see compiled_vehicle.cpp.in

}  // namespace iog::vehicles::reference_car
