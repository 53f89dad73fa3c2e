// The laws of the walk (docs/model.md section 5): it starts and ends right, takes single steps, and
// visits every cell that the line crosses and no other.
#include "traversal/walk.hpp"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "lab/reference/exact_line.hpp"

namespace iog::traversal {
namespace {

// Cells as a walk names them: offsets in a wide grid whose cell (0, 0) lies far from its border.
constexpr std::int32_t kStride = 1 << 14;

Cell cell_of(std::size_t offset) {
  const auto from_origin = static_cast<std::int32_t>(offset);
  const std::int32_t y = numeric::div_floor(from_origin + kStride / 2, kStride);
  return {from_origin - y * kStride, y};
}

template <std::int32_t kResolution>
std::vector<Cell> cells_of(SubcellPoint start, SubcellPoint end) {
  const Line<kResolution> line(start, end);
  std::vector<Cell> cells;
  Walk walk(line, {}, kStride);
  walk.until(line.before({1, 1}).crossed() + 1,
             [&](std::size_t offset) { cells.push_back(cell_of(offset)); });
  return cells;
}

// Draws the cells of a line; digits count the visits in order, '.' is a cell not visited.
std::string map_of(const std::vector<Cell>& cells, int width, int height) {
  std::string map;
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const auto found = std::ranges::find(cells, Cell{x, y});
      const auto place = static_cast<std::size_t>(found - cells.begin());
      map += found == cells.end() ? '.' : static_cast<char>('0' + place % 10);
    }
    map += '\n';
  }
  return map;
}

// y = 5 + (x - 5) 3 / 7: reaches 10 at x = 16.7, the corner (40, 20) exactly, and 30 at x = 63.3.
TEST(Walk, DrawsALine) {
  EXPECT_EQ(map_of(cells_of<10>({5, 5}, {75, 35}), 8, 4),
            "......89\n"
            "....567.\n"
            ".234....\n"
            "01......\n");
}

TEST(Walk, GoesThroughACornerDiagonally) {
  EXPECT_EQ(map_of(cells_of<10>({5, 5}, {35, 35}), 4, 4),
            "...3\n"
            "..2.\n"
            ".1..\n"
            "0...\n");
  EXPECT_EQ(map_of(cells_of<10>({35, 5}, {5, 35}), 4, 4),
            "3...\n"
            ".2..\n"
            "..1.\n"
            "...0\n");
}

TEST(Walk, EndsWhereALineEndsOnACornerOrABorder) {
  EXPECT_EQ(cells_of<10>({5, 5}, {30, 30}).size(), 3U);
  EXPECT_EQ(cells_of<10>({35, 5}, {20, 20}).size(), 2U);
  EXPECT_EQ(cells_of<10>({5, 5}, {30, 5}).size(), 3U);
  EXPECT_EQ(cells_of<10>({5, 5}, {5, 5}).size(), 1U);
  EXPECT_EQ(cells_of<10>({10, 10}, {10, 10}).size(), 1U);
}

TEST(Walk, AlongABorderStaysInTheCellsAboveIt) {
  EXPECT_EQ(map_of(cells_of<10>({0, 10}, {40, 10}), 4, 3),
            "....\n"
            "0123\n"
            "....\n");
  EXPECT_EQ(map_of(cells_of<10>({40, 10}, {0, 10}), 5, 3),
            ".....\n"
            "43210\n"
            ".....\n");
}

// A start on a border whose line leaves to the lower side: the start cell is the one that holds the
// point by floor division, visited although the line only touches it (docs/model.md section 5).
TEST(Walk, StartsInTheCellThatHoldsTheStart) {
  EXPECT_EQ(map_of(cells_of<10>({20, 25}, {2, 21}), 4, 3),
            "210.\n"
            "....\n"
            "....\n");
}

template <std::int32_t kResolution>
void expect_crossed_cells_and_no_other(SubcellPoint start, SubcellPoint end) {
  const std::vector<Cell> cells = cells_of<kResolution>(start, end);
  const Cell start_cell{numeric::div_floor(start.x, kResolution),
                        numeric::div_floor(start.y, kResolution)};
  const auto place = [&] {
    return ::testing::Message() << "r " << kResolution << ", (" << start.x << ", " << start.y
                                << ") to (" << end.x << ", " << end.y << ")";
  };
  ASSERT_TRUE(cells.front() == start_cell) << place();
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const int dx = std::abs(cells[i].x - cells[i - 1].x);
    const int dy = std::abs(cells[i].y - cells[i - 1].y);
    ASSERT_TRUE(dx <= 1 && dy <= 1 && dx + dy >= 1) << place();
    ASSERT_TRUE(lab::reference::segment_crosses(start, end, cells[i], kResolution)) << place();
  }
  const auto floor_of = [](std::int32_t a) { return numeric::div_floor(a, kResolution); };
  std::size_t crossed = 0;
  for (int x = floor_of(std::min(start.x, end.x)); x <= floor_of(std::max(start.x, end.x)); ++x) {
    for (int y = floor_of(std::min(start.y, end.y)); y <= floor_of(std::max(start.y, end.y)); ++y) {
      const bool crosses = lab::reference::segment_crosses(start, end, {x, y}, kResolution);
      crossed += crosses || Cell{x, y} == start_cell ? 1U : 0U;
    }
  }
  ASSERT_EQ(cells.size(), crossed) << place();
}

// Segments that often touch borders, corners and the axes: what breaks walks.
template <std::int32_t kResolution>
void try_random_segments(int count, std::int32_t reach_cells) {
  tests::Random random(kResolution);
  const std::int32_t reach = reach_cells * kResolution;
  for (int i = 0; i < count; ++i) {
    const auto coordinate = [&] {
      const std::int32_t any = random.between(-reach, reach);
      return random.one_in(4) ? any / kResolution * kResolution : any;
    };
    const SubcellPoint start{coordinate(), coordinate()};
    SubcellPoint end{coordinate(), coordinate()};
    end.x = random.one_in(8) ? start.x : end.x;
    end.y = random.one_in(8) ? start.y : end.y;
    expect_crossed_cells_and_no_other<kResolution>(start, end);
    if (::testing::Test::HasFatalFailure()) {
      return;
    }
  }
}

TEST(Walk, AMillionShortSegmentsAtTheResolutionsOfTable42) {
  const int count = tests::effort(220'000, 2'000);
  try_random_segments<1>(count, 5);
  try_random_segments<20>(count, 3);
  try_random_segments<100>(count, 3);
  try_random_segments<200>(count, 3);
  try_random_segments<1024>(count, 3);
}

TEST(Walk, LongSegments) {
  const int count = tests::effort(2'000, 20);
  try_random_segments<1>(count, 60);
  try_random_segments<20>(count, 60);
  try_random_segments<100>(count, 60);
  try_random_segments<1024>(count, 60);
}

}  // namespace
}  // namespace iog::traversal
