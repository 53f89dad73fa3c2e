// A level lidar that turns, with lines as long and beams as steep as a description may have them:
// they end up to 7.4 km over and under the grid. Its tables are computed when the tests start, so
// that sanitizers see it.
#pragma once

#include <algorithm>
#include <array>

#include "fakes/test_vehicles.hpp"
#include "vehicle/compile.hpp"

namespace iog::tests {

struct SteepVlp16 {
  static constexpr std::array<double, 16> kElevationsDeg{-89, -85, -80, -45, -10, -2, -1, -0.5,
                                                         0.5, 1,   2,   10,  45,  80, 85, 89};
  static constexpr std::array kLasers = [] {
    std::array<lidar::Laser, kElevationsDeg.size()> lasers{};
    std::ranges::transform(kElevationsDeg, lasers.begin(), [](double elevation_deg) {
      return lidar::Laser{.elevation_deg = elevation_deg};
    });
    return lasers;
  }();
  static constexpr std::array kConfigs{[] {
    auto config = test_vlp16(100, {.x_m = 1.234, .y_m = -0.777, .z_m = 1.5, .yaw_deg = 23.7});
    config.range_max_mm = vehicle::kLongestRangeMm;
    config.lasers = kLasers;
    return config;
  }()};
  static constexpr vehicle::Description kDescription{
      .name = "steep_vlp16", .z_min_m = 0.3, .z_max_m = 2.2};
  static_assert([] {
    bool is_allowed = true;
    vehicle::check_sensor(kDescription, kConfigs[0], 0,
                          [&](const vehicle::Fault& /*fault*/) { is_allowed = false; });
    return is_allowed;
  }());
  static inline const vehicle::Vehicle kVehicle = [] {
    static const std::array sensors{vehicle::compile_sensor(kConfigs[0], kDescription)};
    return vehicle::join_vehicle(kDescription, sensors);
  }();
};

}  // namespace iog::tests
