// Block by block or cell by cell: the same cells are as much freer.
#include "grid/carving.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <utility>
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

// From anywhere in the grid to anywhere in it, some of them short, some along an axis, some nearly.
BeamLine random_line(tests::Random& random) {
  constexpr std::int32_t kEnd = geometry::kCellsPerSide * kResolution - 1;
  const auto near = [&](std::int32_t from, std::int32_t reach) {
    return std::clamp<std::int32_t>(from + random.between(-reach, reach), 0, kEnd);
  };
  const SubcellPoint start{random.between(0, kEnd), random.between(0, kEnd)};
  const std::int32_t reach = random.one_in(3) ? 8 * kResolution : 500 * kResolution;
  SubcellPoint end{near(start.x, reach), near(start.y, reach)};
  if (random.one_in(6)) {
    end.x = near(start.x, random.one_in(2) ? 0 : kResolution);
  } else if (random.one_in(5)) {
    end.y = near(start.y, random.one_in(2) ? 0 : kResolution);
  }
  return {start, end};
}

std::vector<Cell> cells_of_walk(const BeamLine& line, std::uint32_t end) {
  std::vector<Cell> cells;
  traversal::Walk(line, {}, geometry::kCellsPerSide).until(end, [&](std::size_t number) {
    cells.push_back(geometry::cell_of(number));
  });
  return cells;
}

// The positions of a line that meets no corner, one a border.
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

// The cells of a path, one block after the other, are those of the walk, in the order of blocks.
TEST(BlockPath, GoesThroughTheCellsOfTheWalk) {
  tests::Random random(1);
  for (int i = 0; i < tests::effort(3'000, 60); ++i) {
    const BeamLine line = random_line(random);
    if (traversal::may_meet_corner(line)) {
      continue;
    }
    const std::uint32_t end = line.before({1, 1}).crossed() + 1;
    const std::vector<Cell> cells = cells_of_walk(line, end);
    BlockPath path;
    path.begin(line);
    path.extend_to(path.block_at(positions_of(line, cells).back()));
    std::size_t at = 0;
    for (std::uint32_t block = 0; at < cells.size(); ++block) {
      std::size_t in_block = 0;
      const std::uint32_t first = offset_of(cells[at]) / kLaneCount;
      for (; at < cells.size() && offset_of(cells[at]) / kLaneCount == first; ++at, ++in_block) {
        ASSERT_EQ(path.cells(block).bytes[offset_of(cells[at]) % kLaneCount], -1);
      }
      // The last block goes on beyond the end of the line.
      if (at < cells.size()) {
        ASSERT_EQ(std::ranges::count(path.cells(block).bytes, std::int8_t{-1}),
                  static_cast<std::ptrdiff_t>(in_block));
      }
    }
  }
}

TEST(BlockPath, NamesTheTilesThatItEnters) {
  tests::Random random(2);
  for (int i = 0; i < tests::effort(1'000, 30); ++i) {
    const BeamLine line = random_line(random);
    if (traversal::may_meet_corner(line)) {
      continue;
    }
    const std::vector<Cell> cells = cells_of_walk(line, line.before({1, 1}).crossed() + 1);
    std::vector<std::size_t> expected;
    for (const Cell& cell : cells) {
      if (expected.empty() || expected.back() != geometry::tile_of(cell)) {
        expected.push_back(geometry::tile_of(cell));
      }
    }
    BlockPath path;
    path.begin(line);
    const std::uint32_t last = path.block_at(positions_of(line, cells).back());
    path.extend_to(last);
    std::vector<std::size_t> named;
    path.for_each_tile(last, [&](std::size_t tile) { named.push_back(tile); });
    ASSERT_EQ(named, expected);
  }
}

// A beam's steps at random places of a line, into two grids that hold anything not above 0.
TEST(Carving, BlockByBlockIsCellByCell) {
  tests::Random random(3);
  const auto by_blocks = std::make_unique<BlockGrid>();
  const auto by_cells = std::make_unique<BlockGrid>();
  for (int i = 0; i < tests::effort(2'000, 40); ++i) {
    const BeamLine line = random_line(random);
    if (traversal::may_meet_corner(line)) {
      continue;
    }
    const std::vector<Cell> cells = cells_of_walk(line, line.before({1, 1}).crossed() + 1);
    const std::vector<Position> positions = positions_of(line, cells);
    BlockPath path;
    path.begin(line);
    FreeSteps steps;
    for (int beam = random.between(1, 4); beam > 0; --beam) {
      const auto last = static_cast<std::size_t>(
          random.between(0, static_cast<std::int32_t>(positions.size()) - 1));
      const std::size_t first = random.one_in(2) ? 0 : last / 2;
      const std::int32_t freer = random.between(1, 127);
      if (first == 0) {
        steps.add_from_start(freer);
      } else {
        steps.add({positions[first], false}, freer);
      }
      steps.add({positions[last], first == last || random.one_in(2)}, -freer);
    }
    carve_blocks(*by_blocks, path, steps);
    carve_cells(*by_cells, line, {}, steps);
    for (const Cell& cell : cells) {
      ASSERT_EQ(int{by_blocks->at(cell)}, int{by_cells->at(cell)})
          << i << ": " << cell.x << ", " << cell.y;
      ASSERT_TRUE(by_blocks->at(cell) == 0 || by_blocks->is_touched(geometry::tile_of(cell)));
    }
  }
  std::size_t different = 0;
  for (std::size_t number = 0; number < geometry::kCellCount; ++number) {
    different += by_blocks->at(geometry::cell_of(number)) == by_cells->at(geometry::cell_of(number))
                     ? 0U
                     : 1U;
  }
  EXPECT_EQ(different, 0U);
}

}  // namespace
}  // namespace iog::grid
