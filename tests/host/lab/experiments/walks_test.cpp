// The walks whose cost is measured on the Cortex-A9 visit the cells that the references visit: what
// is timed is right.
#include "lab/target/walks.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "lab/reference/traversal.hpp"
#include "lab/target/fan.hpp"

namespace iog::lab {
namespace {

namespace reference = reference;
using geometry::Cell;

using Cells = std::vector<Cell>;

template <typename Walk>
Cells cells_of(BeamEnd end) {
  Cells cells;
  Walk(Walk::end_of(end)).run([&](std::size_t offset) {
    const auto place = static_cast<std::int32_t>(offset);
    cells.push_back({place % kFanStride, place / kFanStride});
  });
  return cells;
}

template <typename Real>
Cells crossed_cells(BeamEnd end) {
  Cells cells;
  reference::walk_continuous<Real>(
      {0, 0}, {static_cast<Real>(in_cells(end.x)), static_cast<Real>(in_cells(end.y))},
      [&](Cell cell) { cells.push_back(cell); });
  return cells;
}

// A beam that ends on a border visits the cell behind it, too: the one that holds its end. Those of
// 0, 30, 60 and 90 degrees do, as sin 30 = 1/2.
template <typename Walk, typename Real>
void expect_crossed_cells_and_that_of_the_end() {
  const auto fan = make_fan();
  for (std::size_t beam = 0; beam < kBeamCount; ++beam) {
    Cells cells = cells_of<Walk>(fan[beam]);
    if (beam % 60 == 0) {
      cells.pop_back();
    }
    ASSERT_EQ(cells, crossed_cells<Real>(fan[beam])) << "beam " << beam;
  }
}

TEST(BenchWalks, ContinuousOnesVisitWhatIsCrossed) {
  expect_crossed_cells_and_that_of_the_end<ContinuousWalk<double>, double>();
  expect_crossed_cells_and_that_of_the_end<ContinuousWalk<float>, float>();
  expect_crossed_cells_and_that_of_the_end<RealErrorWalk<float>, float>();
}

// The discrete line ends where the rounded end is: half a subcell away at most, so that it may miss
// or add a cell beside a corner, a few in a hundred thousand (table 4.2: 99.99 %).
TEST(BenchWalks, TheDiscreteOneVisitsAlmostTheSame) {
  const auto fan = make_fan();
  std::size_t crossed = 0;
  std::size_t found = 0;
  for (std::size_t beam = 0; beam < kBeamCount; ++beam) {
    const Cells cells = cells_of<DiscreteWalk<1024>>(fan[beam]);
    for (const Cell cell : crossed_cells<double>(fan[beam])) {
      ++crossed;
      found += std::ranges::count(cells, cell) > 0 ? 1U : 0U;
    }
  }
  EXPECT_GT(static_cast<double>(found), 0.9999 * static_cast<double>(crossed));
}

TEST(BenchWalks, BresenhamIsTheReferences) {
  for (const BeamEnd end : make_fan()) {
    ASSERT_EQ(cells_of<BresenhamWalk>(end),
              reference::cells_bresenham({0, 0}, BresenhamWalk::end_of(end)));
  }
}

// Table 4.2's lidar: 181 beams of 50 m at half a degree, from east to north.
TEST(BenchWalks, TheFanIsThatOfTheThesis) {
  const auto fan = make_fan();
  EXPECT_EQ(in_cells(fan[0].x), 500);
  EXPECT_EQ(in_cells(fan[0].y), 0);
  EXPECT_NEAR(in_cells(fan[1].y), 500 * 0.0087265355, 1e-6);  // sin 0.5 degrees
  EXPECT_EQ(in_cells(fan[60].y), 250);
  EXPECT_NEAR(in_cells(fan[90].x), 500 * 0.70710678119, 1e-6);
  EXPECT_EQ(in_cells(fan[180].x), 0);
  EXPECT_EQ(in_cells(fan[180].y), 500);
}

}  // namespace
}  // namespace iog::lab
