#include "lab/evaluation/visibility.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "description/scanners.hpp"
#include "drawn_cells.hpp"
#include "grid/frame_fusion.hpp"

namespace iog::lab {
namespace {

// A scanner in the middle of the cell at the grid's centre that looks forward, half a metre up; the
// height band begins at its lowest beams' feet and ends above its highest.
constexpr description::MountConfig kMount{.x_m = 0.05, .y_m = 0.05, .z_m = 0.5};
const std::array kScanner{[] {
  description::SensorConfig config = description::scanner_of(lidar::kFormat<lidar::IbeoLux>);
  config.name = "front";
  config.udp_port = 1;
  config.mount = kMount;
  config.max_points_per_scan = 2412;
  return config;
}()};
constexpr description::Description kDescription{.name = "test", .z_min_m = 0.2, .z_max_m = 2.0};
const tools::CatalogueEntry kCar{
    .vehicle = nullptr, .description = &kDescription, .sensors = kScanner, .network = nullptr};

std::vector<CellState> seen(const std::vector<tools::Solid>& solids,
                            const tools::EgoPose& ego = {}) {
  return visibility(kCar, ego, solids);
}

// Rows y = 518 ... 506 of columns 512 ... 536, the scanner in column 512 of row 512.
std::vector<std::string> crop(const std::vector<CellState>& cells) {
  std::vector<std::string> rows;
  for (std::size_t y = 518; y >= 506; --y) {
    rows.push_back(drawing(cells, y * geometry::kCellsPerSide + 512, 25));
  }
  return rows;
}

// A pillar 0.2 m deep and 0.3 m wide, 0.95 m ahead of the scanner. By ruler: the field of view
// opens along y = +-1.19 x (50 degrees), the pillar's shadow begins along y = +-0.158 x (its near
// corners).
TEST(Visibility, IsFreeBeforeOccupiedAtAndUnknownBehindASolid) {
  const std::vector<std::string> expected{
      "     ....................",  //
      "    .....................",  //
      "   ......................",  //
      "  .....................  ",  //
      " ................        ",  //
      "..........#              ",  //
      "..........#              ",  //
      "..........#              ",  //
      " ................        ",  //
      "  .....................  ",  //
      "   ......................",  //
      "    .....................",  //
      "     ....................",
  };
  EXPECT_EQ(crop(seen({box(tools::Material::kWall, {.x = 1.1, .y = 0.05}, 0.2, 0.3, 0, 2)})),
            expected);
}

std::string row_ahead(const std::vector<CellState>& cells) {
  return drawing(cells, std::size_t{512} * geometry::kCellsPerSide + 512, 25);
}

// 1 m ahead, 0.3 m deep, 0.49 m high: the two lower layers end on it, the upper two pass over.
TEST(Visibility, ABeamOverALowSolidSaysNothingOfIt) {
  const tools::Solid low = box(tools::Material::kCar, {.x = 1.15, .y = 0}, 0.3, 2, 0, 0.49);
  EXPECT_EQ(row_ahead(seen({low})), "..........#  ............");
}

// A kerb lower than the band is no obstacle by the car's description, and ends no beam here.
TEST(Visibility, WhatLiesBelowTheBandIsFree) {
  const tools::Solid kerb = box(tools::Material::kKerb, {.x = 1.15, .y = 0}, 0.3, 2, 0, 0.12);
  EXPECT_EQ(row_ahead(seen({kerb})), ".........................");
}

// A solid that hangs above the band ends the beam in which it is, yet nothing is marked there.
TEST(Visibility, OnlyThePartOfABeamInsideTheBandCounts) {
  constexpr description::Description kLowBand{.name = "test", .z_min_m = 0.2, .z_max_m = 0.51};
  const tools::CatalogueEntry car{
      .vehicle = nullptr, .description = &kLowBand, .sensors = kScanner, .network = nullptr};
  // The upper layers leave the band after 0.01 / tan 1.2 degrees = 0.48 m and 1.4 m, the lower ones
  // see the ground below the solid.
  const auto cells = visibility(
      car, {}, std::vector{box(tools::Material::kWall, {.x = 2, .y = 0}, 0.2, 2, 0.52, 2)});
  EXPECT_EQ(std::ranges::count(cells, CellState::kOccupied), 0);
  EXPECT_EQ(row_ahead(cells), ".........................");
}

// The model's range is 50 m, the grid's half side 51.2 m.
TEST(Visibility, EndsWithTheRange) {
  const auto cells = seen({box(tools::Material::kWall, {.x = 50.8, .y = 0}, 0.4, 2, 0, 2)});
  EXPECT_EQ(drawing(cells, std::size_t{512} * geometry::kCellsPerSide + 1008, 16),
            ".....           ");
}

// The grid turns and moves with the car.
TEST(Visibility, IsTheSameFromEveryPlace) {
  const tools::Solid here = box(tools::Material::kWall, {.x = 3, .y = 1}, 0.5, 2, 0, 2);
  const tools::Solid there =
      box(tools::Material::kWall, {.x = 100 - 1, .y = 50 + 3, .cos = 0, .sin = 1}, 0.5, 2, 0, 2);
  const tools::EgoPose ego{.at = {.x = 100, .y = 50, .cos = 0, .sin = 1}};
  EXPECT_EQ(crop(seen({here})), crop(seen({there}, ego)));
}

// With the nose down by 3 degrees the beams meet the ground after 0.5 m / tan(1.8 ... 4.2 degrees),
// 16 m at most, and leave the band before.
TEST(Visibility, APitchedCarSeesTheRoad) {
  const tools::EgoPose ego{.at = {}, .pitch_cos = 0.99863, .pitch_sin = 0.05234};
  const auto cells = seen({}, ego);
  // (0.5 + what the mount sinks - 0.2) / tan 1.8 degrees = 9.5 m
  EXPECT_EQ(drawing(cells, std::size_t{512} * geometry::kCellsPerSide + 512 + 90, 10),
            "......    ");
}

}  // namespace
}  // namespace iog::lab
