// Block by block or cell by cell: the same cells are as much freer.
#include "grid/carving.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "traversal/corner.hpp"
#include "traversal/walk.hpp"

namespace iog::grid {
namespace {

using geometry::Cell;
using geometry::kResolution;
using geometry::SubcellPoint;
using traversal::Position;
using vehicle::BeamLine;

// From anywhere in a grid to anywhere in it, some of them short, some along an axis, some nearly,
// some from a corner between cells.
BeamLine random_line(tests::Random& random, const geometry::CellArea& area = geometry::kGridArea) {
  const std::int32_t x_end = area.width * kResolution - 1;
  const std::int32_t y_end = area.height * kResolution - 1;
  const auto near = [&](std::int32_t from, std::int32_t reach, std::int32_t last) {
    return std::clamp<std::int32_t>(from + random.between(-reach, reach), 0, last);
  };
  SubcellPoint start{random.between(0, x_end), random.between(0, y_end)};
  if (random.one_in(4)) {
    start = {start.x / kResolution * kResolution, start.y / kResolution * kResolution};
  }
  const std::int32_t reach = random.one_in(3) ? 8 * kResolution : 500 * kResolution;
  SubcellPoint end{near(start.x, reach, x_end), near(start.y, reach, y_end)};
  if (random.one_in(6)) {
    end.x = near(start.x, random.one_in(2) ? 0 : kResolution, x_end);
  } else if (random.one_in(5)) {
    end.y = near(start.y, random.one_in(2) ? 0 : kResolution, y_end);
  }
  return {start, end};
}

std::vector<Cell> cells_of_walk(const BeamLine& line, std::uint32_t end) {
  std::vector<Cell> cells;
  traversal::Walk(line, {}, geometry::kLongestSide).until(end, [&](std::size_t number) {
    cells.push_back(geometry::cell_of(number, geometry::kLongestSide));
  });
  return cells;
}

// The positions of a line that meets no corner after its start, one a border.
std::vector<Position> positions_of(const BeamLine& line, const std::vector<Cell>& cells) {
  std::vector<Position> positions;
  positions.reserve(cells.size());
  const Cell start = line.cell({});
  for (const Cell& cell : cells) {
    positions.push_back({static_cast<std::uint32_t>((cell.x - start.x) * line.x().step()),
                         static_cast<std::uint32_t>((cell.y - start.y) * line.y().step())});
  }
  return positions;
}

LaneBytes cells_of(const BlockPath& path, std::uint32_t block) {
  const Way way = path.way_from(nullptr, {});
  if (block > 0) {
    return way.masks[way.next_codes[block - 1] / 2U];
  }
  LaneBytes cells;
  Lanes::load(way.cells()).bit_and(path.start_mask()).store(cells);
  return cells;
}

// The cells of a path, one block after the other, are those of the walk, in the order of blocks.
TEST(BlockPath, GoesThroughTheCellsOfTheWalk) {
  tests::Random random(1);
  const auto usual = std::make_unique<BlockGrid>();
  for (int i = 0; i < tests::effort(3'000, 60); ++i) {
    const BeamLine line = random_line(random);
    if (traversal::may_meet_corner(line)) {
      continue;
    }
    const std::uint32_t end = line.before({1, 1}).crossed() + 1;
    const std::vector<Cell> cells = cells_of_walk(line, end);
    BlockPath path;
    path.begin(line, *usual);
    path.find_up_to(path.block_at(positions_of(line, cells).back()));
    std::size_t at = 0;
    const std::vector<Position> positions = positions_of(line, cells);
    for (std::uint32_t block = 0; at < cells.size(); ++block) {
      std::size_t in_block = 0;
      if (block < path.block_at(positions[at])) {
        ASSERT_TRUE(block == 1 && traversal::starts_on_corner(line));
        ASSERT_EQ(std::ranges::count(cells_of(path, block).bytes, std::int8_t{-1}), 0);
        continue;
      }
      const std::uint32_t first = offset_of(cells[at], kBlockStride) / kLaneCount;
      for (; at < cells.size() && offset_of(cells[at], kBlockStride) / kLaneCount == first;
           ++at, ++in_block) {
        ASSERT_EQ(cells_of(path, block).bytes[offset_of(cells[at], kBlockStride) % kLaneCount], -1);
      }
      // The last block goes on beyond the end of the line.
      if (at < cells.size()) {
        ASSERT_EQ(std::ranges::count(cells_of(path, block).bytes, std::int8_t{-1}),
                  static_cast<std::ptrdiff_t>(in_block));
      }
    }
  }
}

// 64 tiles a row, and 16 rows.
constexpr geometry::Grid kLong{
    .columns = 2048, .rows = 512, .origin_column = 48, .origin_row = 256};

TEST(BlockPath, NamesTheTilesThatItEnters) {
  tests::Random random(2);
  const auto grid = std::make_unique<BlockGrid>(kLong);
  for (int i = 0; i < tests::effort(1'000, 30); ++i) {
    const BeamLine line = random_line(random, kLong.area());
    if (traversal::may_meet_corner(line)) {
      continue;
    }
    const std::vector<Cell> cells = cells_of_walk(line, line.before({1, 1}).crossed() + 1);
    std::vector<std::size_t> expected;
    for (const Cell& cell : cells) {
      const auto tile = static_cast<std::size_t>(cell.y / 32 * 64 + cell.x / 32);
      if (expected.empty() || expected.back() != tile) {
        expected.push_back(tile);
      }
    }
    BlockPath path;
    path.begin(line, *grid);
    std::vector<std::size_t> named;
    path.for_each_tile(positions_of(line, cells).back(),
                       grid->strides(path.orientation().number()).tiles,
                       [&](std::size_t tile) { named.push_back(tile); });
    // Each of them once or more.
    named.erase(std::unique(named.begin(), named.end()), named.end());
    ASSERT_EQ(named, expected);
  }
}

// A beam's steps at random places of a line, into two grids that hold anything not above 0.
template <typename Steps>
void expect_that_blocks_are_cells(std::uint64_t seed, const geometry::Grid& grid = {}) {
  tests::Random random(seed);
  const auto by_blocks = std::make_unique<BlockGrid>(grid);
  const auto by_cells = std::make_unique<BlockGrid>(grid);
  for (int i = 0; i < tests::effort(2'000, 40); ++i) {
    const BeamLine line = random_line(random, grid.area());
    if (traversal::may_meet_corner(line)) {
      continue;
    }
    const std::vector<Cell> cells = cells_of_walk(line, line.before({1, 1}).crossed() + 1);
    const std::vector<Position> positions = positions_of(line, cells);
    BlockPath path;
    path.begin(line, *by_blocks);
    const auto block_steps = std::make_unique<Steps>();
    const auto cell_steps = std::make_unique<Steps>();
    for (int beam = random.between(1, 4); beam > 0; --beam) {
      const auto last = static_cast<std::size_t>(
          random.between(0, static_cast<std::int32_t>(positions.size()) - 1));
      const std::size_t first = random.one_in(2) ? 0 : last / 2;
      const std::int32_t freer = random.between(1, 127);
      const bool is_after = first == last || random.one_in(2);
      const Between end =
          is_after ? Between::after(positions[last]) : Between::before(positions[last]);
      for (FreeSteps* steps : {block_steps.get(), cell_steps.get()}) {
        steps->begin_beam(Between::before(positions[first]), freer);
        steps->add(end, -freer);
        steps->end_beam(end);
      }
    }
    carve_blocks(*by_blocks, path, *block_steps);
    carve_cells(*by_cells, line, {}, *cell_steps);
    for (const Cell& cell : cells) {
      ASSERT_EQ(int{by_blocks->at(cell)}, int{by_cells->at(cell)})
          << i << ": " << cell.x << ", " << cell.y;
      ASSERT_TRUE(by_blocks->at(cell) == 0 ||
                  by_blocks->is_touched(geometry::tile_of(cell, grid.tiles_across())));
    }
  }
  std::size_t different = 0;
  for (std::size_t number = 0; number < geometry::kCellCount; ++number) {
    const Cell cell = geometry::cell_of(number, grid.columns);
    different += by_blocks->at(cell) == by_cells->at(cell) ? 0U : 1U;
  }
  EXPECT_EQ(different, 0U);
}

TEST(Carving, BlockByBlockIsCellByCell) { expect_that_blocks_are_cells<FreeSteps>(3); }
TEST(Carving, WhatGapsHaveIsPassed) { expect_that_blocks_are_cells<LowSteps>(4); }
TEST(Carving, BlockByBlockIsCellByCellOnLongGrids) {
  expect_that_blocks_are_cells<FreeSteps>(5, kLong);
  expect_that_blocks_are_cells<LowSteps>(6, {.columns = 256, .rows = 4096});
}

// The longest lines of a car are below 2,048 cells in |dx| + |dy| (car_block/limits.cpp: the error
// term), so below 1,448 cells. Of all grids of the most cells, and on either axis: a line in a grid
// of w by h crosses at most w + h - 2 borders of cells, and at most 2 more than |dx| + |dy|. The
// same is true of blocks, and block 0 comes on top. docs/model.md has r = 1024.
TEST(Carving, NoGridHasALineWithMoreBordersThanSlots) {
  for (int width = 32; width <= geometry::kLongestSide; width += 32) {
    const int height =
        std::min<int>(geometry::kLongestSide, int{geometry::kCellCount} / width / 32 * 32);
    int most = 0;
    int most_blocks = 0;
    for (int dx = 0; dx <= std::min(width, 1448); ++dx) {
      const int dy = std::min(height, static_cast<int>(std::sqrt(1448.2 * 1448.2 - dx * dx)) + 1);
      most = std::max(most, std::min(width + height - 2, dx + dy + 2));
      most_blocks = std::max(
          most_blocks, std::min(width / 4 - 1, dx / 4 + 1) + std::min(height / 4 - 1, dy / 4 + 1));
    }
    EXPECT_LE(most, int{FreeSteps::kSlots} - 2) << width;
    EXPECT_LE(most_blocks, int{BlockPath::kMaxBlocks} - 1) << width;
  }
}

// One point between two cells has two names: after the one, before the other. Beams that change
// there by either name, in either order, carve what two beams carve that name it alike.
TEST(Carving, APointBetweenTwoCellsHasTwoNames) {
  const BeamLine line({300, 200}, {40 * kResolution + 700, 23 * kResolution + 10});
  ASSERT_FALSE(traversal::may_meet_corner(line));
  const std::vector<Cell> cells = cells_of_walk(line, line.before({1, 1}).crossed() + 1);
  const std::vector<Position> positions = positions_of(line, cells);
  for (std::size_t at = 0; at + 1 < positions.size(); ++at) {
    for (const bool after_first : {false, true}) {
      const auto grid = std::make_unique<BlockGrid>();
      const auto steps = std::make_unique<FreeSteps>();
      BlockPath path;
      path.begin(line, *grid);
      const Between after = Between::after(positions[at]);
      const Between before = Between::before(positions[at + 1]);
      steps->begin_beam(Between::before({}), 14 + 14);
      steps->add(after_first ? after : before, -7);
      steps->add(after_first ? before : after, -14);
      steps->add(Between::after(positions.back()), -7);
      steps->end_beam(Between::after(positions.back()));
      carve_blocks(*grid, path, *steps);
      for (std::size_t i = 0; i < cells.size(); ++i) {
        ASSERT_EQ(int{grid->at(cells[i])}, i <= at ? -28 : -7) << at << ", " << i;
      }
    }
  }
}

}  // namespace
}  // namespace iog::grid
