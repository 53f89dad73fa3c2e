// Grids of other sizes of cells and other rectangles (docs/model.md section 8), held against the
// grid of 1024 x 1024 cells of 0.1 m, whose cells the other tests hold against their references.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/compiled_car.hpp"
#include "fakes/effort.hpp"
#include "fakes/evidence.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fusion/frame_fusion.hpp"

namespace iog::fusion {
namespace {

using description::Description;
using description::GridConfig;
using description::SensorConfig;
using tests::CompiledCar;
using tests::Evidence;
using Cells = std::vector<grid::OccupancyIndex>;

Cells fuse(const vehicle::Vehicle& car, const std::vector<Evidence>& frame) {
  const auto fusion = std::make_unique<FrameFusion>(car);
  for (const Evidence& evidence : frame) {
    fusion->add(car.sensors[evidence.sensor], evidence.point);
  }
  fusion->finish();
  return tests::cells_of(*fusion);
}

std::vector<Evidence> points_of(const vehicle::Vehicle& car, tests::Random& random, int count) {
  std::vector<Evidence> frame;
  for (int i = 0; i < count; ++i) {
    const std::size_t number = random.below(car.sensors.size());
    const vehicle::Sensor& sensor = car.sensors[number];
    const auto turn = sensor.azimuths.ticks_per_turn();
    // A LUX looks ahead only.
    const auto ticks = static_cast<std::uint32_t>(random.below(turn / 4)) + turn * 7 / 8;
    frame.push_back({number,
                     {.range_mm = static_cast<std::uint32_t>(
                          10 * random.between(20, static_cast<int>(sensor.range.mm()) / 10)),
                      .azimuth_ticks = static_cast<std::uint16_t>(ticks % turn),
                      .layer = static_cast<std::uint8_t>(random.below(sensor.layer_count))}});
  }
  return frame;
}

constexpr std::array kRectangles{
    GridConfig{.ahead_m = 51.2, .behind_m = 0, .left_m = 16, .right_m = 16},
    GridConfig{.ahead_m = 9.6, .behind_m = 16, .left_m = 3.2, .right_m = 6.4},
};

// What lies inside is as if the grid were without end (docs/model.md section 5), and the rest of
// the memory stays unknown.
template <typename Car>
void expect_parts_of_the_whole(std::uint64_t seed) {
  tests::Random random(seed);
  const auto frame = points_of(Car::kVehicle, random, tests::effort(400, 40));
  const Cells whole = fuse(Car::kVehicle, frame);
  for (const GridConfig& rectangle : kRectangles) {
    Description car = Car::kDescription;
    car.grid = rectangle;
    const CompiledCar compiled(Car::kConfigs, car);
    const geometry::Grid& grid = compiled.vehicle.grid;
    const Cells part = fuse(compiled.vehicle, frame);
    std::size_t known = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const geometry::Cell cell = geometry::cell_of(i, grid.columns);
      const geometry::Cell same{cell.x + geometry::kOriginCell - grid.origin_column,
                                cell.y + geometry::kOriginCell - grid.origin_row};
      const int expected = grid.area().contains(cell)
                               ? whole[static_cast<std::size_t>(geometry::number_of(same))]
                               : 0;
      ASSERT_EQ(int{part[i]}, expected) << cell.x << ", " << cell.y;
      known += part[i] != 0 ? 1U : 0U;
    }
    EXPECT_GT(known, 100U);
  }
}

TEST(Geometry, ARectangleIsAPartOfTheWholeGrid) {
  expect_parts_of_the_whole<tests::ThreeLux>(1);
  expect_parts_of_the_whole<tests::TiltedLux>(2);
  expect_parts_of_the_whole<tests::MixedCar>(3);
  expect_parts_of_the_whole<tests::RadarCar>(4);
  expect_parts_of_the_whole<tests::UltrasonicCar>(5);
}

// Ahead and behind meet at the car. Its lidars see beyond the 51.2 m of the usual grid.
TEST(Geometry, ALongGridIsMadeOfItsHalves) {
  std::vector<SensorConfig> configs(2, tests::LevelVlp16::kConfigs[0]);
  configs[1].mount.yaw_deg += 180;
  for (SensorConfig& config : configs) {
    config.range_max_mm = 60'000;
  }
  Description car = tests::LevelVlp16::kDescription;
  car.grid = {.ahead_m = 102.4, .behind_m = 102.4, .left_m = 25.6, .right_m = 25.6};
  const CompiledCar all(configs, car);
  tests::Random random(7);
  auto frame = points_of(all.vehicle, random, 2'000);
  const Cells cells = fuse(all.vehicle, frame);
  std::ranges::reverse(frame);  // no order shows
  for (const bool is_ahead : {false, true}) {
    car.grid.ahead_m = is_ahead ? 102.4 : 0;
    car.grid.behind_m = is_ahead ? 0 : 102.4;
    const CompiledCar half(configs, car);
    const Cells expected = fuse(half.vehicle, frame);
    std::size_t far = 0;
    for (std::size_t i = 0; i < std::size_t{1024} * 512; ++i) {
      const std::size_t place = i / 1024 * 2048 + i % 1024 + (is_ahead ? 1024U : 0U);
      ASSERT_EQ(int{cells[place]}, int{expected[i]}) << place;
      far += expected[i] != 0 && (i % 1024 < 512) != is_ahead ? 1U : 0U;
    }
    EXPECT_GT(far, 100U);
  }
}

// A pitched VLP-16 and two LUX of 20 m, and a world `scale` times as large, cells included. Lines
// and 1D cells are then the same, so each cell is.
struct ScaledWorld {
  std::vector<SensorConfig> configs;
  Description car = tests::TiltedLux::kDescription;

  explicit ScaledWorld(double scale) {
    configs.assign(tests::MixedCar::kConfigs.begin() + 1, tests::MixedCar::kConfigs.end());
    configs.push_back(tests::TiltedLux::kConfigs[0]);
    for (SensorConfig& config : configs) {
      config.mount.x_m *= scale;
      config.mount.y_m *= scale;
      config.mount.z_m *= scale;
      config.range_min_mm = 0;
      config.range_max_mm = scaled(20'000, scale);
      config.no_return_clears_mm = scaled(10'000, scale);
      config.precision_mm = scaled(100, scale);
      config.sigma_m = 0.1 * scale;
    }
    car.footprint = {-scale, scale, -scale, scale};
    car.z_min_m *= scale;
    car.z_max_m *= scale;
    car.grid = GridConfig{.cell_m = 0.1 * scale};
  }

  static std::uint32_t scaled(std::uint32_t mm, double scale) {
    return static_cast<std::uint32_t>(mm * scale + 0.5);
  }
};

TEST(Geometry, AWorldAsMuchLargerAsItsCellsIsTheSame) {
  const ScaledWorld usual(1);
  const CompiledCar small(usual.configs, usual.car);
  tests::Random random(6);
  const auto frame = points_of(small.vehicle, random, tests::effort(600, 60));
  const Cells expected = fuse(small.vehicle, frame);
  EXPECT_GT(std::ranges::count_if(expected, [](auto index) { return index > 0; }), 10);
  for (const double scale : {0.5, 2.0, 5.0}) {
    const ScaledWorld world(scale);
    const CompiledCar car(world.configs, world.car);
    std::vector<Evidence> larger = frame;
    for (Evidence& evidence : larger) {
      evidence.point.range_mm = ScaledWorld::scaled(evidence.point.range_mm, scale);
    }
    ASSERT_EQ(fuse(car.vehicle, larger), expected) << scale;
  }
}

}  // namespace
}  // namespace iog::fusion
