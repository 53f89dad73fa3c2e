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

// A car of the tests on another grid. Beams in cells of 5 cm can be walked if they are at most 60 m
// long. In a long grid, they are 120 m long.
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
      const bool is_long = grid.ahead_m > 102.4 && config.range_max_mm > 60'000;
      config.range_max_mm =
          is_long ? 120'000 : std::min<std::uint32_t>(config.range_max_mm, 60'000);
    }
  }
};

// The other sizes of a cell, a rectangle ahead of 51.2 x 32 m, and 2,048 x 512 and 512 x 2,048
// cells.
inline const std::array kOtherGrids{
    description::GridConfig{.cell_m = 0.05},
    description::GridConfig{.cell_m = 0.2},
    description::GridConfig{.cell_m = 0.5},
    description::GridConfig{.ahead_m = 51.2, .behind_m = 0, .left_m = 16, .right_m = 16},
    description::GridConfig{.ahead_m = 200, .behind_m = 4.8, .left_m = 25.6, .right_m = 25.6},
    description::GridConfig{.ahead_m = 25.6, .behind_m = 25.6, .left_m = 3.2, .right_m = 201.6}};

}  // namespace iog::tests
