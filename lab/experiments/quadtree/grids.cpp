#include "lab/experiments/quadtree/grids.hpp"

#include <cstddef>

#include "fusion/frame_fusion.hpp"
#include "tools/simulate/random.hpp"

namespace iog::lab {
namespace {

using Cells = std::vector<index::OccupancyIndex>;

// What a beam leaves of the cells that it passes, and of the one where it ends.
constexpr index::OccupancyIndex kFree = -14;
constexpr index::OccupancyIndex kHit = 2;

constexpr std::size_t kSingleCells = 1000;

template <typename Draw>
Cells drawn(Draw&& draw) {
  Cells cells(geometry::kCellCount);
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    cells[cell] = draw(cell % geometry::kCellsPerSide, cell / geometry::kCellsPerSide);
  }
  return cells;
}

Cells single_cells(std::uint64_t seed) {
  Cells cells(geometry::kCellCount);
  tools::Random random(seed);
  for (std::size_t count = 0; count < kSingleCells;) {
    index::OccupancyIndex& cell = cells[random.below(cells.size())];
    count += cell == kHit ? 0U : 1U;
    cell = kHit;
  }
  return cells;
}

index::OccupancyIndex one_in_each_tile(std::size_t x, std::size_t y) {
  return x % geometry::kTileSide == 5 && y % geometry::kTileSide == 7 ? kHit : index::kUnknown;
}

index::OccupancyIndex checkerboard(std::size_t x, std::size_t y) {
  return (x + y) % 2 == 0 ? kFree : kHit;
}

}  // namespace

std::vector<NamedGrid> drawn_grids(std::uint64_t seed) {
  return {{"all unknown", Cells(geometry::kCellCount)},
          {"all free by one beam", Cells(geometry::kCellCount, kFree)},
          {std::to_string(kSingleCells) + " single cells at random", single_cells(seed)},
          {"a single cell in each tile", drawn(one_in_each_tile)},
          {"checkerboard", drawn(checkerboard)}};
}

}  // namespace iog::lab
