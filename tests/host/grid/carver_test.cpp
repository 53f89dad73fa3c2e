// The law by which carving can be shared out among cores: carvers that carve apart, each on a grid
// of its own, carve together what one carver does.
#include <algorithm>
#include <array>
#include <deque>
#include <gtest/gtest.h>
#include <memory>
#include <span>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/evidence.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fusion/frame_fusion.hpp"
#include "grid/azimuth_carver.hpp"
#include "grid/pending_marks.hpp"
#include "grid/turn_carver.hpp"
#include "index/occupancy_index.hpp"

namespace iog::grid {
namespace {

using tests::Evidence;
using vehicle::Vehicle;

// What a core would have for itself: both carvers on one grid.
struct Core {
  explicit Core(const Vehicle& vehicle)

      : grids(vehicle.window.is_opened_from_below),
        azimuths(vehicle, grids, marks),
        turns(vehicle, grids, marks) {}

  void add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point) {
    if (sensor.layers_share_lines) {
      turns.turn_to(sensor).add(point);
    } else {
      azimuths.add(sensor, point);
    }
  }
  void carve_waiting() {
    azimuths.carve_waiting();
    turns.carve_waiting();
  }

  FrameGrids grids;
  PendingMarks marks;
  AzimuthCarver azimuths;
  TurnCarver turns;
};

using Cores = std::deque<Core>;

Cores idle_cores(const Vehicle& vehicle, int count) {
  Cores cores;
  for (int i = 0; i < count; ++i) {
    cores.emplace_back(vehicle);
  }
  return cores;
}

// Each beam goes to any core, `at_once` of them one after the other to the same.
void carve_apart(const Vehicle& vehicle, std::span<const Evidence> frame, std::size_t at_once,
                 tests::Random& random, Cores& cores) {
  for (std::size_t i = 0, core = 0; i < frame.size(); ++i) {
    core = i % at_once == 0 ? random.below(cores.size()) : core;
    cores[core].add(vehicle.sensors[frame[i].sensor], frame[i].point);
  }
  for (Core& core : cores) {
    core.carve_waiting();
  }
}

// Adds what was carved in `from`: both have indexes of one sign, 0 or below.
void join(const BlockGrid& from, BlockGrid& to) {
  for (std::size_t number = 0; number < geometry::kCellCount; ++number) {
    const geometry::Cell cell = geometry::cell_of(number);
    const OccupancyIndex carved = from.at(cell);
    ASSERT_LE(int{carved}, 0);
    ASSERT_LE(int{to.at(cell)}, 0);
    if (carved != index::kUnknown) {
      to.cell_at(offset_of(cell, kBlockStride)) = index::sat_add(to.at(cell), carved);
      to.touch(geometry::tile_of(cell));
    }
  }
}

std::vector<OccupancyIndex> cells_of(const BlockGrid& grid) {
  std::vector<OccupancyIndex> cells(geometry::kCellCount);
  grid.copy_cells(std::span(cells).first<geometry::kCellCount>());
  return cells;
}

// All grids into the last, then all marks.
std::vector<OccupancyIndex> joined(Cores& cores, vehicle::FusionRule rule) {
  BlockGrid& grid = cores.back().grids.indexes;
  for (Core& core : cores) {
    if (&core.grids.indexes != &grid) {
      join(core.grids.indexes, grid);
    }
  }
  for (Core& core : cores) {
    core.marks.apply(cores.back().grids, rule);
  }
  return cells_of(grid);
}

std::vector<OccupancyIndex> fused_by_one(const Vehicle& vehicle, std::span<const Evidence> frame) {
  const auto fusion = std::make_unique<fusion::FrameFusion>(vehicle);
  for (const Evidence& evidence : frame) {
    fusion->add(vehicle.sensors[evidence.sensor], evidence.point);
  }
  fusion->finish();
  return tests::cells_of(*fusion);
}

// Few azimuths, so that many beams share a line and cells saturate in one grid and not in another.
std::vector<Evidence> dense_frame(tests::Random& random, const Vehicle& vehicle, int points) {
  std::vector<Evidence> frame = tests::random_frame(random, points);
  for (Evidence& evidence : frame) {
    evidence.sensor %= vehicle.sensors.size();
    evidence.point.azimuth_ticks =
        static_cast<std::uint16_t>(evidence.point.azimuth_ticks / 16 * 16);
  }
  return frame;
}

Vehicle with_rule(Vehicle vehicle, vehicle::FusionRule rule) {
  vehicle.rule = rule;
  return vehicle;
}

void expect_that_no_split_shows(const Vehicle& vehicle, tests::Random& random) {
  const auto frame = dense_frame(random, vehicle, tests::effort(2000, 300));
  const auto expected = fused_by_one(vehicle, frame);
  // Some cells are saturated, some are not, and some are marked: else the law would be trivial.
  EXPECT_GT(std::ranges::count(expected, OccupancyIndex{-127}), 20);
  EXPECT_GT(std::ranges::count_if(expected, [](int i) { return -127 < i && i < 0; }), 20);
  if (vehicle.rule == vehicle::FusionRule::kHitsWin) {
    EXPECT_GT(std::ranges::count_if(expected, [](int i) { return i > 0; }), 20);
  }
  for (const std::size_t at_once : {1U, 7U, 100U}) {
    for (const int count : {2, 3, 4}) {
      if (!random.one_in(tests::effort(1, 4))) {
        continue;
      }
      Cores cores = idle_cores(vehicle, count);
      carve_apart(vehicle, frame, at_once, random, cores);
      ASSERT_TRUE(joined(cores, vehicle.rule) == expected) << count << " cores, " << at_once;
    }
  }
}

TEST(Carver, GridsCarvedApartAddUpToTheGridOfOneCarver) {
  tests::Random random(91);
  for (const auto rule : {vehicle::FusionRule::kHitsWin, vehicle::FusionRule::kBayes}) {
    expect_that_no_split_shows(with_rule(tests::LevelLux::kVehicle, rule), random);
    expect_that_no_split_shows(with_rule(tests::ThreeLux::kVehicle, rule), random);
    expect_that_no_split_shows(with_rule(tests::OneLuxNearest::kVehicle, rule), random);
    expect_that_no_split_shows(with_rule(tests::MixedCar::kVehicle, rule), random);
  }
}

// Only carving may be joined so: with marks among it, the sum depends on who had them.
TEST(Carver, GridsThatWereMarkedBeforeDoNotAddUp) {
  const Vehicle vehicle = with_rule(tests::LevelLux::kVehicle, vehicle::FusionRule::kBayes);
  const vehicle::Sensor& sensor = vehicle.sensors[0];
  const lidar::ScanPoint far{.range_mm = 10'050, .layer = 2};
  const lidar::ScanPoint near{.range_mm = 5'050, .layer = 2};
  Cores cores = idle_cores(vehicle, 2);
  for (int i = 0; i < 10; ++i) {
    cores[0].add(sensor, far);
  }
  cores[0].add(sensor, near);
  cores[1].add(sensor, far);
  std::array<int, 2> indexes{};
  for (std::size_t i = 0; i < cores.size(); ++i) {
    cores[i].carve_waiting();
    cores[i].marks.apply(cores[i].grids, vehicle.rule);
    indexes[i] = int{cores[i].grids.indexes.at({512 + 50, 512})};
  }
  // sat(-140) + 2 and -14; one carver has sat(-154) + 2.
  EXPECT_EQ(indexes, (std::array{-125, -14}));
  EXPECT_EQ(int{index::sat_add(static_cast<OccupancyIndex>(indexes[0]),
                               static_cast<OccupancyIndex>(indexes[1]))},
            -127);
  std::vector<Evidence> frame(11, {0, far});
  frame.push_back({0, near});
  EXPECT_EQ(int{fused_by_one(vehicle, frame)[512 * geometry::kCellsPerSide + 512 + 50]}, -125);
}

TEST(Carver, WhatIsDroppedIsNotCarved) {
  for (const Vehicle& vehicle : {tests::LevelLux::kVehicle, tests::LevelVlp16::kVehicle}) {
    const auto carves = std::make_unique<Core>(vehicle);
    const auto drops = std::make_unique<Core>(vehicle);
    for (Core* const core : {carves.get(), drops.get()}) {
      core->add(vehicle.sensors[0], {.range_mm = 10'050, .layer = 2});
    }
    drops->azimuths.drop_waiting();
    drops->turns.drop_waiting();
    for (Core* const core : {carves.get(), drops.get()}) {
      core->carve_waiting();
    }
    EXPECT_GT(std::ranges::count_if(cells_of(carves->grids.indexes), [](int i) { return i < 0; }),
              50);
    EXPECT_EQ(std::ranges::count_if(cells_of(drops->grids.indexes), [](int i) { return i < 0; }),
              0);
  }
}

}  // namespace
}  // namespace iog::grid
