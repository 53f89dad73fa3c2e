// What the peers' walks are said to be, as laws: see the descriptions in the header.
#include "lab/reference/peer_walks.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <utility>

#include "fakes/random.hpp"
#include "lab/reference/exact_line.hpp"

namespace iog::lab::reference {
namespace {

using Cells = std::vector<Cell>;

Cell random_cell(tests::Random& random, std::int32_t reach) {
  return {random.between(-reach, reach), random.between(-reach, reach)};
}

// Half the longer extent, rounded down, is half of an odd extent less a half; but an odd extent has
// no tie. So it is Bresenham's line, ties included.
TEST(LikeNav2, IsBresenhamsLine) {
  tests::Random random(1);
  for (int round = 0; round < 4000; ++round) {
    const Cell from = random_cell(random, 60);
    const Cell to = random_cell(random, 60);
    ASSERT_EQ(cells_like_nav2(from, to), cells_bresenham(from, to));
  }
}

// The free cells are; what the rounding of a step adds up to is made good by the step to the
// target.
TEST(LikeMrpt, IsEightConnectedAndEndsAtTheTarget) {
  tests::Random random(2);
  for (int round = 0; round < 4000; ++round) {
    const Cell from = random_cell(random, 250);
    const Cell to = random_cell(random, 250);
    const Cells cells = cells_like_mrpt(from, to);
    const auto longer = std::max(std::abs(to.x - from.x), std::abs(to.y - from.y));
    ASSERT_EQ(cells.front(), from);
    ASSERT_EQ(cells.back(), to);
    ASSERT_EQ(cells.size(), static_cast<std::size_t>(longer) + 1);
    for (std::size_t i = 1; i < cells.size(); ++i) {
      const std::int32_t most = i + 1 < cells.size() ? 1 : 2;
      ASSERT_LE(std::abs(cells[i].x - cells[i - 1].x), most);
      ASSERT_LE(std::abs(cells[i].y - cells[i - 1].y), most);
    }
  }
}

// From corner to corner, rounded down: the walk lies below the line, by less than a cell and what
// a step's rounding of at most 1/1024 adds up to.
TEST(LikeMrpt, IsRoundedDown) {
  tests::Random random(3);
  for (int round = 0; round < 4000; ++round) {
    const Cell to = random_cell(random, 500);
    const Cells cells = cells_like_mrpt({0, 0}, to);
    const auto count = static_cast<double>(cells.size() - 1);
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
      const auto walked = static_cast<double>(i);
      const double drift = walked / 1024;
      const double below_x = to.x * walked / count - cells[i].x;
      const double below_y = to.y * walked / count - cells[i].y;
      ASSERT_GE(below_x, -drift);
      ASSERT_GE(below_y, -drift);
      ASSERT_LT(below_x, 1 + drift);
      ASSERT_LT(below_y, 1 + drift);
    }
  }
}

TEST(LikeCartographer, CrossesWhatRationalGeometrySays) {
  constexpr std::int32_t kHalves = 2000;  // of a thousandth, per cell
  tests::Random random(4);
  const auto odd = [&] { return 2 * random.between(-6000, 6000) + 1; };
  for (int round = 0; round < 2000; ++round) {
    const geometry::SubcellPoint start{odd(), odd()};
    const geometry::SubcellPoint end{odd(), odd()};
    std::set<std::pair<std::int32_t, std::int32_t>> crossed;
    for (std::int32_t y = -7; y <= 7; ++y) {
      for (std::int32_t x = -7; x <= 7; ++x) {
        if (segment_crosses(start, end, {x, y}, kHalves)) {
          crossed.emplace(x, y);
        }
      }
    }
    // Anywhere within the thousandth that these are the centres of.
    const auto near = [&](std::int32_t centre) {
      return (centre + random.between(-999, 999) * 0.001) / kHalves;
    };
    const Cells cells =
        cells_like_cartographer({near(start.x), near(start.y)}, {near(end.x), near(end.y)});
    std::set<std::pair<std::int32_t, std::int32_t>> visited;
    for (const Cell cell : cells) {
      visited.emplace(cell.x, cell.y);
    }
    ASSERT_EQ(visited.size(), cells.size());
    ASSERT_EQ(visited, crossed);
  }
}

TEST(LikeCartographer, TakesDegenerateLines) {
  EXPECT_EQ(cells_like_cartographer({0.5, 0.5}, {0.5, 0.5}), (Cells{{0, 0}}));
  EXPECT_EQ(cells_like_cartographer({0.5, 0.5}, {0.5, 2.5}), (Cells{{0, 0}, {0, 1}, {0, 2}}));
  EXPECT_EQ(cells_like_cartographer({0.5, 2.5}, {0.5, 0.5}), (Cells{{0, 2}, {0, 1}, {0, 0}}));
  EXPECT_EQ(cells_like_cartographer({0.0005, 0.0005}, {2.0005, 2.0005}),
            (Cells{{0, 0}, {1, 1}, {2, 2}}));
}

}  // namespace
}  // namespace iog::lab::reference
