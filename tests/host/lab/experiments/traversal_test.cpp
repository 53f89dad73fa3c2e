// The thesis's table 4.2, and what decides its numbers.
#include <cmath>
#include <gtest/gtest.h>

#include "lab/experiments/traversal/traversal_trial.hpp"

namespace iog::lab {
namespace {

double percent_found(int resolution, Rounding rounding, Stand stand) {
  return 100 * cover(discrete_walk(resolution, rounding), stand).share_found();
}

// 99.50, 99.90 and 99.95 % by table 4.2; 99.99 % at 1000 by a tenth of 1 / r, the law of the
// others.
TEST(TraversalAccuracy, IsThatOfTheThesis) {
  for (const Stand stand : {Stand::kCorner, Stand::kCellCentre}) {
    EXPECT_NEAR(percent_found(20, Rounding::kNearest, stand), 99.50, 0.05);
    EXPECT_NEAR(percent_found(100, Rounding::kNearest, stand), 99.90, 0.05);
    EXPECT_NEAR(percent_found(200, Rounding::kNearest, stand), 99.95, 0.05);
    EXPECT_NEAR(percent_found(1000, Rounding::kNearest, stand), 99.99, 0.05);
  }
}

// "85 %" of figure 4.11a lies among what the choices that the thesis leaves open give.
TEST(TraversalAccuracy, DependsOnRoundingAtOneSubcellACell) {
  EXPECT_GT(percent_found(1, Rounding::kNearest, Stand::kCorner), 85);
  EXPECT_GT(percent_found(1, Rounding::kDown, Stand::kCorner), 85);
  EXPECT_LT(percent_found(1, Rounding::kNearest, Stand::kCellCentre), 85);
  EXPECT_LT(percent_found(1, Rounding::kDown, Stand::kCellCentre), 85);
}

// "With a traversal resolution greater than 100, the discrete algorithm is accurate at more than
// 99.9 %"; and geometry says how much more, to half of the misses.
TEST(TraversalAccuracy, MissesWhatGeometryExpects) {
  for (const int r : {2, 10, 50, 256, 1024}) {
    const Coverage coverage = cover(discrete_walk(r, Rounding::kNearest), Stand::kCorner);
    const double expected = expected_misses(r, coverage.crossed);
    EXPECT_NEAR(coverage.share_missed(), expected, 0.5 * expected) << r;
    if (r > 100) {
      EXPECT_GT(coverage.share_found(), 0.999) << r;
    }
  }
}

TEST(TraversalAccuracy, CountsACellOnceABeam) {
  const auto nowhere = [](CellPoint, CellPoint) { return std::vector<reference::Cell>(); };
  const Coverage none = cover(nowhere, Stand::kCorner);
  EXPECT_EQ(none.found, 0U);
  EXPECT_EQ(none.beside, 0U);
  const Coverage all = cover(reference::cells_continuous, Stand::kCorner);
  EXPECT_EQ(all.found, all.crossed);
  EXPECT_EQ(all.crossed, none.crossed);
  // A line of length L crosses |L cos| columns' and |L sin| rows' borders on the grid: 4 / pi L in
  // the mean over a quarter turn, that is 637 cells of a beam of 500.
  EXPECT_NEAR(static_cast<double>(all.crossed) / 181, 637, 4);
}

// Two walks between the centres of the same two cells.
TEST(TraversalAccuracy, LooksBothWaysAlike) {
  const auto bresenham = [](CellPoint start, CellPoint end) {
    const auto cell_of = [](CellPoint point) {
      return reference::Cell{static_cast<std::int32_t>(std::floor(point.x)),
                             static_cast<std::int32_t>(std::floor(point.y))};
    };
    return reference::cells_bresenham(cell_of(start), cell_of(end));
  };
  const Coverage ahead = cover(bresenham, Stand::kCellCentre);
  const Coverage back = cover(bresenham, Stand::kOppositeCentre);
  EXPECT_EQ(ahead.crossed, back.crossed);
  EXPECT_EQ(ahead.found, back.found);
  EXPECT_EQ(ahead.beside, back.beside);
}

}  // namespace
}  // namespace iog::lab
