// Cars that a test compiles itself, such as those with other grids than the usual one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/car/tables.hpp"

namespace iog::tests {

struct CompiledCar {
  std::vector<vehicle::Sensor> sensors;
  vehicle::Vehicle vehicle;

  CompiledCar(std::span<const description::SensorConfig> configs,
              const description::Description& car) {
    for (const description::SensorConfig& config : configs) {
      sensors.push_back(description::sensor_of(config, car));
    }
    vehicle = description::vehicle_of(car, sensors);
  }
  CompiledCar(const CompiledCar&) = delete;
  CompiledCar& operator=(const CompiledCar&) = delete;
};

// A car of the tests on another grid. Its beams are at most 60 m long, so that they can be walked
// in cells of 5 cm.
template <typename Car>
struct CarOn {
  std::vector<description::SensorConfig> configs{Car::kConfigs.begin(), Car::kConfigs.end()};
  description::Description description = Car::kDescription;
  CompiledCar compiled;

  explicit CarOn(const description::GridConfig& grid)
      : compiled((prepare(grid), configs), description) {}

 private:
  void prepare(const description::GridConfig& grid) {
    description.grid = grid;
    for (description::SensorConfig& config : configs) {
      config.range_max_mm = std::min<std::uint32_t>(config.range_max_mm, 60'000);
    }
  }
};

// The other sizes of a cell, and a rectangle ahead: 51.2 x 32 m.
inline const std::array kOtherGrids{
    description::GridConfig{.cell_m = 0.05}, description::GridConfig{.cell_m = 0.2},
    description::GridConfig{.cell_m = 0.5},
    description::GridConfig{.ahead_m = 51.2, .behind_m = 0, .left_m = 16, .right_m = 16}};

}  // namespace iog::tests
