// Affine maps between the vehicle's grid and the window, against rational numbers.
#include "placing/placement.hpp"

#include <array>
#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "placing/exact_place.hpp"
#include "placing/slice.hpp"

namespace iog::placing {
namespace {

using geometry::Cell;
using tests::ExactPoint;
using tests::placed;

constexpr double kFine = 1 << kFineBits;

// The usual grid, other sizes of cells, and a rectangle ahead.
constexpr std::array<geometry::Grid, 4> kGrids{
    {{},
     {.cell_mm = 200},
     {.cell_mm = 500},
     {.columns = 512, .rows = 320, .origin_column = 0, .origin_row = 160}}};

Placement somewhere(tests::Random& random) {
  constexpr std::int32_t kFar = 1'000'000'000;  // mm
  const int degrees_e4 = random.between(0, 3'599'999);
  Placement at = placed(random.between(-kFar, kFar), random.between(-kFar, kFar), degrees_e4 / 1e4);
  at.grid = kGrids[random.below(kGrids.size())];
  return at;
}

window::Area around(const Placement& at) {
  return window::Area::around(window::cell_of(at.pose, at.grid.cell_mm));
}

// Where the additions within a tile bring a cell of it, `in_tile` from its first.
FinePoint stepped(const CellMap& map, Cell first, Cell in_tile) {
  FinePoint point = map.exact(first);
  for (std::int32_t y = 0; y < in_tile.y; ++y) {
    point = along_y(point, map.step());
  }
  for (std::int32_t x = 0; x < in_tile.x; ++x) {
    point = along_x(point, map.step());
  }
  return point;
}

// In 2^-16 cells, how far a coordinate is above the exact one.
double error(std::int32_t fine, const tests::ExactCoordinate& exact, std::int32_t first_cell) {
  const std::int64_t cells = exact.cell() - std::int64_t{first_cell};
  const std::int64_t rest = exact.numerator - exact.cell() * exact.denominator;
  return static_cast<double>(fine - cells * (1 << kFineBits)) -
         static_cast<double>(rest) / static_cast<double>(exact.denominator) * kFine;
}

struct Extremes {
  double least = 0;
  double most = 0;
  void take(double error) {
    least = std::min(least, error);
    most = std::max(most, error);
  }
};

Cell random_first(tests::Random& random) {
  return {static_cast<std::int32_t>(random.below(32)) * window::kTileSide,
          static_cast<std::int32_t>(random.below(32)) * window::kTileSide};
}
Cell random_in_tile(tests::Random& random) {
  return {random.between(0, window::kTileSide - 1), random.between(0, window::kTileSide - 1)};
}

TEST(Placement, CellsOfTheWindowArePlacedInTheGridToALittleLessThanAThousandthCell) {
  tests::Random random(1);
  Extremes errors;
  for (int pose = 0; pose < tests::effort(1000, 100); ++pose) {
    const Placement at = somewhere(random);
    const window::Area area = around(at);
    const CellMap map = CellMap::to_grid(area, at);
    for (int i = 0; i < 40; ++i) {
      const Cell first = random_first(random);
      const Cell in_tile = random_in_tile(random);
      const ExactPoint exact =
          tests::exact_in_grid({area.corner().a * window::kTileSide + first.x + in_tile.x,
                                area.corner().b * window::kTileSide + first.y + in_tile.y},
                               at);
      const FinePoint point = stepped(map, first, in_tile);
      errors.take(error(point.x, exact.x, 0));
      errors.take(error(point.y, exact.y, 0));
    }
  }
  EXPECT_GT(errors.least, -32.0);
  EXPECT_LE(errors.most, 31.0);
  EXPECT_LT(errors.least, -8.0) << "the bounds are of use";
}

TEST(Placement, CellsOfTheGridArePlacedInTheWindowToALittleLessThanAThousandthCell) {
  tests::Random random(2);
  Extremes errors;
  for (int pose = 0; pose < tests::effort(1000, 100); ++pose) {
    const Placement at = somewhere(random);
    const window::Area area = around(at);
    const CellMap map = CellMap::to_window(area, at);
    for (int i = 0; i < 40; ++i) {
      const Cell first = random_first(random);
      const Cell in_tile = random_in_tile(random);
      const ExactPoint exact =
          tests::exact_in_frame({first.x + in_tile.x, first.y + in_tile.y}, at);
      const FinePoint point = stepped(map, first, in_tile);
      errors.take(error(point.x, exact.x, area.corner().a * window::kTileSide));
      errors.take(error(point.y, exact.y, area.corner().b * window::kTileSide));
    }
  }
  EXPECT_GT(errors.least, -32.0);
  EXPECT_LE(errors.most, 31.0);
}

// The first cell of a tile is the exact value, rounded down.
TEST(Placement, TheFirstCellOfATileIsExact) {
  tests::Random random(3);
  for (int pose = 0; pose < 200; ++pose) {
    const Placement at = somewhere(random);
    const window::Area area = around(at);
    const Cell first = random_first(random);
    const FinePoint in_grid = CellMap::to_grid(area, at).exact(first);
    const ExactPoint exact = tests::exact_in_grid({area.corner().a * window::kTileSide + first.x,
                                                   area.corner().b * window::kTileSide + first.y},
                                                  at);
    const double x = error(in_grid.x, exact.x, 0);
    const double y = error(in_grid.y, exact.y, 0);
    ASSERT_TRUE(x > -1 && x <= 0) << x;
    ASSERT_TRUE(y > -1 && y <= 0) << y;
  }
}

// A car whose origin is the corner of cells: what is a cell ahead in the grid is one to the left in
// the window at a quarter turn.
TEST(Placement, QuarterTurnsMapCellsOntoCells) {
  const window::Area area({-16, -16});  // the vehicle is at its middle, cell (512, 512)
  const auto in_window = [&](Cell cell, double degrees) {
    return CellMap::to_window(area, placed(0, 0, degrees)).exact(cell).cell();
  };
  EXPECT_EQ(in_window({512 + 32, 512}, 0), (Cell{544, 512}));
  EXPECT_EQ(in_window({512 + 32, 512}, 90), (Cell{511, 544}));
  EXPECT_EQ(in_window({512 + 32, 512}, 180), (Cell{479, 511}));
  EXPECT_EQ(in_window({512 + 32, 512}, 270), (Cell{512, 479}));
  EXPECT_EQ(in_window({512 + 32, 512 - 64}, 90), (Cell{575, 544}));
}

}  // namespace
}  // namespace iog::placing
