// How fusing can be divided: what a way to divide it must keep, whichever it is.
#include "lab/experiments/fusing_splits.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

#include "grid/carving.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

constexpr BlockPlane kFine{0.1};

FusingWork frame_of_drive(const BlockPlane& plane) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  tools::Drive drive(car, 1, 1);
  return work_of(car, drive.datagrams(3), plane);
}

// A way to the right and down, from (0.1, 0.1): it crosses x = 0.4 at y = -0.05, y = 0 at x = 0.3.
TEST(FusingWork, AWayGoesThroughBlocksOfFourCells) {
  const std::uint32_t middle = 128 * 256 + 128;
  EXPECT_EQ(blocks_on(kFine, {0.1, 0.1, 0.5, -0.1}),
            (std::vector{middle, middle - 256, middle - 255}));
  EXPECT_EQ(blocks_on({0.2}, {0.1, 0.1, 0.5, -0.1}),
            (std::vector<std::uint32_t>{64 * 128 + 64, 63 * 128 + 64}));
  EXPECT_EQ(blocks_on(kFine, {51.1, 0.1, 60, 0.1}), (std::vector{middle + 127}));
}

TEST(FusingWork, TilesAreEightBlocksWide) {
  EXPECT_EQ(kFine.tile_count(), 1024U);
  EXPECT_EQ(BlockPlane{0.2}.tile_count(), 256U);
  EXPECT_EQ(kFine.tile_of(8 * 256 + 17), 32U + 2);
}

// The line of a sensor at an azimuth, to its end.
Way2 way_of(const vehicle::Sensor& sensor, const vehicle::BeamLine& line) {
  const double x = static_cast<double>(sensor.origin.x) / 10'240 - 51.2;
  const double y = static_cast<double>(sensor.origin.y) / 10'240 - 51.2;
  return {x, y, x + line.x().step() * static_cast<double>(line.x().length()) / 10'240,
          y + line.y().step() * static_cast<double>(line.y().length()) / 10'240};
}

// The first blocks of a path, numbered without the two that a row is stored longer.
std::vector<std::uint32_t> blocks_of(grid::BlockPath& path, std::size_t count) {
  path.find_up_to(static_cast<std::uint32_t>(count) - 1);
  const grid::Way way = path.way_from(nullptr);
  const grid::BlockCode* const codes = way.next_codes - 1;
  auto stored = static_cast<std::ptrdiff_t>(path.start_offset() / grid::kLaneCount);
  std::vector<std::uint32_t> blocks;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = static_cast<std::uint32_t>(stored);
    blocks.push_back(number / grid::kBlockStride * 256 + number % grid::kBlockStride);
    stored += (codes[i] & 1U) != 0 ? way.strides.v : way.strides.u;
  }
  return blocks;
}

TEST(FusingWork, BlocksAreThoseOfTheFirmwaresPaths) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  std::size_t compared = 0;
  for (const LineWork& line : frame_of_drive(kFine).lines) {
    const vehicle::Sensor& sensor = car.vehicle->sensors[line.sensor];
    grid::KeptLine kept;
    kept.find(sensor, sensor.layers[0], line.azimuth);
    if (kept.has_path()) {
      const auto blocks = blocks_on(kFine, way_of(sensor, kept.line()));
      ASSERT_EQ(blocks_of(kept.path(), blocks.size()), blocks) << line.azimuth;
      ++compared;
    }
  }
  EXPECT_GT(compared, 500U);
}

TEST(FusingSplits, WhoIsIdleGetsTheNextItem) {
  EXPECT_EQ(deal(std::vector<double>{4, 1, 1, 1, 1, 9}, 2),
            (std::vector<std::size_t>{0, 1, 1, 1, 1, 0}));
  EXPECT_EQ(deal(std::vector<double>{1, 1, 1}, 4), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(FusingSplits, EverySplitDoesAllOfTheWork) {
  const FusingWork work = frame_of_drive(kFine);
  const Division alone = divide(work, kFine, Split::kPackets, 1);
  for (std::size_t split = 0; split < kSplitNames.size(); ++split) {
    for (const std::size_t cores : {1U, 2U, 3U, 4U}) {
      const Division division = divide(work, kFine, static_cast<Split>(split), cores);
      EXPECT_EQ(division.effort.blocks, alone.effort.blocks) << kSplitNames[split];
      EXPECT_EQ(division.effort.marks, alone.effort.marks) << kSplitNames[split];
      EXPECT_GE(division.effort.points, alone.effort.points) << kSplitNames[split];
      EXPECT_GE(division.effort.tiles, alone.effort.tiles) << kSplitNames[split];
      // Nobody finishes what all do together before his share of it is done.
      EXPECT_GE(division.longest() * static_cast<double>(cores), division.busy());
    }
  }
}

// One core alone has nothing of a split but its work.
TEST(FusingSplits, OneCoreTakesTheSameBySevenWays) {
  const FusingWork work = frame_of_drive(kFine);
  const double alone = divide(work, kFine, Split::kCells, 1).longest();
  for (std::size_t split = 0; split < kSplitNames.size(); ++split) {
    EXPECT_NEAR(divide(work, kFine, static_cast<Split>(split), 1).longest(), alone, 1e-6 * alone)
        << kSplitNames[split];
  }
}

// Two lines of 3 and 1 points through one row of blocks, by hand.
TEST(FusingSplits, CostsAreThoseOfTheWork) {
  FusingWork work{{{0, 0, 5, 3, {0, 1, 2}, {3}}, {1, 1, 6, 1, {40}, {}}}, 2};
  const UnitCosts costs{.point = 100,
                        .line = 10,
                        .block = 2,
                        .mark = 1,
                        .shared_block = 5,
                        .entry = 7,
                        .tile = 1000,
                        .joined = 500,
                        .round = 50};
  // 317 and 112 cycles, in two tiles of one row.
  EXPECT_EQ(divide(work, kFine, Split::kPackets, 1, costs).longest(), 317 + 112 + 2000);
  EXPECT_EQ(divide(work, kFine, Split::kPackets, 2, costs).longest(), 50 + 317 + 50 + 2000);
  EXPECT_EQ(divide(work, kFine, Split::kBeamsShared, 2, costs).longest(), 50 + 326 + 50 + 2000);
  EXPECT_EQ(divide(work, kFine, Split::kCells, 2, costs).longest(), 50 + 429 + 50 + 2000);
  EXPECT_EQ(divide(work, kFine, Split::kRegions, 2, costs).longest(),
            50 + 300 + 50 + 29 + 50 + 2000);
  EXPECT_EQ(divide(work, kFine, Split::kPipeline, 4, costs).longest(), 2000 + 1);
}

}  // namespace
}  // namespace iog::lab
