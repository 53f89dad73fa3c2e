// Which cells beams have freed from below, and which are hit by something tall
// (grid/frame_grids.hpp), against the rule of the cells in a lower and in a higher band.
#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/evidence.hpp"
#include "fakes/ground_car.hpp"
#include "fakes/low_and_tall.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/turning_rule.hpp"
#include "fusion/frame_fusion.hpp"
#include "fusion/joined_grid.hpp"

namespace iog::fusion {
namespace {

using geometry::Cell;
using grid::OccupancyIndex;
using grid::TileBits;
using lidar::ScanPoint;
using tests::Evidence;
using tests::GroundCar;
using tests::LevelVlp16;
using tests::Random;
using vehicle::Fate;

constexpr vehicle::MovedLimits kMoved{.low_mm = 600, .tall_mm = 700};
constexpr vehicle::GroundLimits kFlat{};

// Level, so that its beams are straight through the band: low where the rule of a band that ends at
// 0.6 m frees the cell, tall where the return is in a band that begins at 0.7 m.
TEST(Heights, OfACellAreThoseOfTheLowerAndOfTheHigherBand) {
  const GroundCar car(LevelVlp16::kVehicle, kFlat, kMoved);
  const auto& config = LevelVlp16::kConfigs[0];
  const std::span<const double> elevations(lidar::VelodyneVlp16::kElevationsDeg);
  description::Description lower = LevelVlp16::kDescription;
  lower.z_max_m = 0.6;
  description::Description higher = LevelVlp16::kDescription;
  higher.z_min_m = 0.7;
  const tests::TurningRule rule(config, LevelVlp16::kDescription, elevations);
  const tests::TurningRule low_rule(config, lower, elevations);
  const tests::TurningRule tall_rule(config, higher, elevations);
  const auto fusion = std::make_unique<FrameFusion>(car.vehicle());
  const vehicle::Sensor& sensor = car.vehicle().sensors[0];
  Random random(81);
  std::array<int, 2> seen{};
  for (int i = 0; i < tests::effort(300, 60); ++i) {
    const ScanPoint point = tests::random_point(random, elevations.size(), 60'000);
    const std::optional<tests::TurningRay> ray = rule.ray(point);
    if (!ray) {
      continue;
    }
    const Fate fate = rule.fate(*ray, point);
    ASSERT_EQ(fusion->add(sensor, point), fate);
    fusion->finish();
    const bool is_tall = fate == Fate::kUsed && tall_rule.fate(*ray, point) == Fate::kUsed;
    tests::for_each_cell_around(*ray, [&](Cell cell) {
      const int index = fusion->view().at(cell);
      ASSERT_EQ(index, rule.index(sensor.profile, *ray, point, fate, cell));
      const bool is_low = index < 0 && low_rule.index(sensor.profile, *ray, point, fate, cell) < 0;
      ASSERT_EQ(tests::low_or_tall(*fusion, cell), is_low || (index > 0 && is_tall))
          << "cell " << cell.x << ", " << cell.y << ", index " << index << ", range "
          << point.range_mm << ", tick " << point.azimuth_ticks << ", layer " << int{point.layer};
      ++seen[tests::low_or_tall(*fusion, cell) ? 1 : 0];
    });
    fusion->clear();
  }
  EXPECT_GT(std::ranges::min(seen), 100);
}

// What each point says of a cell for itself: bit 0 that it is free, 1 that it was freed from below,
// 2 that it is hit, 3 that it is hit by something tall.
std::vector<std::uint8_t> said_of_cells(const vehicle::Vehicle& car,
                                        std::span<const Evidence> frame) {
  std::vector<std::uint8_t> said(geometry::kCellCount);
  const auto fusion = std::make_unique<FrameFusion>(car);
  for (const Evidence& evidence : frame) {
    fusion->add(car.sensors[evidence.sensor], evidence.point);
    fusion->finish();
    const auto cells = tests::cells_of(*fusion);
    const auto bits = tests::low_and_tall_of(*fusion);
    for (std::size_t number = 0; number < cells.size(); ++number) {
      const Cell cell = geometry::cell_of(number);
      const bool has_bit = tests::has_bit(bits[geometry::tile_of(cell)], cell);
      if (cells[number] != 0) {
        const unsigned what = cells[number] < 0 ? 1U : 4U;
        said[number] |= static_cast<std::uint8_t>(has_bit ? what | what << 1U : what);
      } else {
        EXPECT_FALSE(has_bit);
      }
    }
    fusion->clear();
  }
  return said;
}

// As of sets: a cell that is hit is tall if any hit is; another one is low if any beam was.
void expect_sums(const vehicle::Vehicle& car, std::vector<Evidence> frame, Random& random) {
  const std::vector<std::uint8_t> said = said_of_cells(car, frame);
  std::ranges::reverse(frame);
  const std::array fusions{std::make_unique<FrameFusion>(car), std::make_unique<FrameFusion>(car)};
  const auto all = std::make_unique<FrameFusion>(car);
  for (const Evidence& evidence : frame) {
    fusions[random.below(2)]->add(car.sensors[evidence.sensor], evidence.point);
    all->add(car.sensors[evidence.sensor], evidence.point);
  }
  all->finish();
  fusions[0]->finish();
  fusions[1]->finish();
  const auto one = tests::low_and_tall_of(*fusions[0]);
  const auto other = tests::low_and_tall_of(*fusions[1]);
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    std::array<OccupancyIndex, geometry::kTileCells> in_one{};
    std::array<OccupancyIndex, geometry::kTileCells> in_other{};
    static_cast<void>(fusions[0]->view().copy_tile(tile, in_one));
    static_cast<void>(fusions[1]->view().copy_tile(tile, in_other));
    EXPECT_EQ(join(in_one, one[tile], in_other, other[tile]), all->low_and_tall(tile)) << tile;
  }
  std::array<int, 2> seen{};
  for (std::size_t number = 0; number < said.size(); ++number) {
    const Cell cell = geometry::cell_of(number);
    const bool is_hit = (said[number] & 4U) != 0;
    const bool expected = (said[number] & (is_hit ? 8U : 2U)) != 0;
    ASSERT_EQ(tests::low_or_tall(*all, cell), expected) << cell.x << ", " << cell.y;
    seen[expected ? 1 : 0] += said[number] != 0 ? 1 : 0;
  }
  EXPECT_GT(std::ranges::min(seen), 0);
}

TEST(Heights, AreSetsOfUnitsThatTurn) {
  Random random(82);
  const GroundCar car(LevelVlp16::kVehicle, kFlat, kMoved);
  std::vector<Evidence> frame;
  for (int i = 0; i < tests::effort(60, 12); ++i) {
    ScanPoint point = tests::random_point(random, 16, 40'000);
    point.azimuth_ticks = static_cast<std::uint16_t>(random.below(200));
    frame.push_back({0, point});
  }
  expect_sums(car.vehicle(), frame, random);
}

TEST(Heights, AreSetsOfUnitsWhoseLayersHaveLinesOfTheirOwn) {
  Random random(83);
  const GroundCar car(tests::ThreeLux::kVehicle, kFlat, {.low_mm = 500, .tall_mm = 600});
  expect_sums(car.vehicle(), tests::random_frame(random, tests::effort(60, 12)), random);
}

// A LUX 0.42 m high, whose layer 2 rises by 0.4 degrees, and a band that begins 0.2 m high. A beam
// that ends on ground 10.05 m away is over the straight line to that ground by 0.42 m less
// a 10.05th of it each metre: for 0.22 m of 0.42, or 5.264 m, over the band's lower end. It frees
// as far as without the flag: as it rises, it leaves cell 98 a little behind 9.9 m, in the last 1D
// cell before its end.
class AheadOfALux : public testing::Test {
 protected:
  // Whether the cell ahead is free, and low.
  struct Ahead {
    bool is_free;
    bool is_low;
  };
  void add(const ScanPoint& point) { fusion_->add(car_.vehicle().sensors[0], point); }
  [[nodiscard]] std::vector<Ahead> finish(std::int32_t cells) {
    fusion_->finish();
    std::vector<Ahead> ahead;
    for (std::int32_t x = 0; x < cells; ++x) {
      const Cell cell{geometry::kOriginCell + x, geometry::kOriginCell};
      ahead.push_back({fusion_->view().at(cell) < 0, tests::low_or_tall(*fusion_, cell)});
    }
    return ahead;
  }

 private:
  GroundCar car_{tests::BumperLux::kVehicle, kFlat, {.low_mm = 800, .tall_mm = 0}};
  std::unique_ptr<FrameFusion> fusion_ = std::make_unique<FrameFusion>(car_.vehicle());
};

TEST_F(AheadOfALux, ABeamIsLowWhereItIsOverTheGroundThatItEndsOn) {
  add({.range_mm = 10'050, .layer = 2, .is_ground = true});
  const std::vector<Ahead> ahead = finish(110);
  for (std::size_t x = 0; x < ahead.size(); ++x) {
    EXPECT_EQ(ahead[x].is_free, x < 98) << x;
    EXPECT_EQ(ahead[x].is_low, x <= 52) << x;
  }
}

TEST_F(AheadOfALux, ABeamThatEndsOnAThingIsLowUpToIt) {
  add({.range_mm = 10'050, .layer = 2});
  const std::vector<Ahead> ahead = finish(98);
  EXPECT_TRUE(std::ranges::all_of(ahead, &Ahead::is_low));
}

TEST_F(AheadOfALux, WhatOneBeamPassesUnderAnotherOpens) {
  add({.range_mm = 10'050, .layer = 2, .is_ground = true});
  add({.range_mm = 20'050, .layer = 2});
  const std::vector<Ahead> ahead = finish(150);
  EXPECT_TRUE(std::ranges::all_of(ahead, &Ahead::is_low));
}

// Ground that is far behind where the beam leaves the band: layer 1 does 31.5 m ahead, and is over
// the line for 22 of 42 parts of the way.
TEST_F(AheadOfALux, ABeamThatLeavesTheBandIsLowInItAsFarAsOverTheGround) {
  add({.range_mm = 40'050, .layer = 1, .is_ground = true});
  const std::vector<Ahead> ahead = finish(350);
  for (std::size_t x = 0; x < ahead.size(); ++x) {
    EXPECT_EQ(ahead[x].is_free, x <= 315) << x;
    EXPECT_EQ(ahead[x].is_low, x <= 209) << x;
  }
}

// A unit on a roof looks down on the ground, and loses what moves by such a rule. Here one that is
// 0.42 m high looks over things because beams are low up to 0.4 m.
TEST(Heights, OfASensorThatLooksOverThingsAreThoseOfTheBandAlone) {
  for (const std::uint16_t low_mm : {std::uint16_t{400}, std::uint16_t{430}}) {
    const GroundCar car(tests::BumperLux::kVehicle, kFlat, {.low_mm = low_mm, .tall_mm = 0});
    const auto fusion = std::make_unique<FrameFusion>(car.vehicle());
    fusion->add(car.vehicle().sensors[0], {.range_mm = 10'050, .layer = 1, .is_ground = true});
    fusion->finish();
    EXPECT_EQ(tests::low_or_tall(*fusion, {geometry::kOriginCell + 90, geometry::kOriginCell}),
              low_mm == 400);
  }
}

// A sensor below the band's lower end would have no beams that open ground.
TEST(Heights, OfASensorBelowTheBandAreThoseOfTheBandAlone) {
  EXPECT_EQ(vehicle::derived_detail::share_over_ground(200, 420),
            22 * (std::uint64_t{1} << 30) / 42);
  EXPECT_EQ(vehicle::derived_detail::share_over_ground(200, 200), 1U << 30);
  EXPECT_EQ(vehicle::derived_detail::share_over_ground(200, 100), 1U << 30);
  EXPECT_EQ(vehicle::derived_detail::share_over_ground(0, 420), 1U << 30);
  EXPECT_EQ(vehicle::derived_detail::share_over_ground(-5, 420), 1U << 30);
}

// A sensor that says nothing has beams that are low everywhere, and tall hits.
TEST(Heights, OfASensorThatSaysNothingAreAllOfThem) {
  Random random(84);
  const GroundCar says(LevelVlp16::kVehicle, kFlat, kMoved);
  std::vector<vehicle::Sensor> sensors(says.vehicle().sensors.begin(),
                                       says.vehicle().sensors.end());
  vehicle::Vehicle car = says.vehicle();
  sensors[0].moved = {};
  vehicle::derive_limits(car.footprint, car.z_min, car.z_max, sensors[0]);
  car.sensors = sensors;
  const auto fusion = std::make_unique<FrameFusion>(car);
  for (int i = 0; i < 300; ++i) {
    fusion->add(sensors[0], tests::random_point(random, 16, 60'000));
  }
  fusion->finish();
  const auto cells = tests::cells_of(*fusion);
  for (std::size_t number = 0; number < cells.size(); ++number) {
    ASSERT_EQ(tests::low_or_tall(*fusion, geometry::cell_of(number)), cells[number] != 0);
  }
}

// Nothing is kept where nobody asks.
TEST(Heights, AreNotKeptIfNoSensorSaysWhatOpensGround) {
  const auto fusion = std::make_unique<FrameFusion>(LevelVlp16::kVehicle);
  fusion->add(LevelVlp16::kVehicle.sensors[0], {.range_mm = 9'000, .layer = 2});
  fusion->finish();
  EXPECT_FALSE(fusion->keeps_heights());
  for (const TileBits& bits : tests::low_and_tall_of(*fusion)) {
    ASSERT_EQ(bits, TileBits{});
  }
}

}  // namespace
}  // namespace iog::fusion
