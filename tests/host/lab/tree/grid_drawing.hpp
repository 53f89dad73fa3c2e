// Grids to build quadtrees of: 1024 by 1024 indexes, row by row from the lowest y.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fakes/random.hpp"
#include "index/occupancy_index.hpp"
#include "lab/tree/linear_quadtree.hpp"

namespace iog::tests {

class GridDrawing {
 public:
  static constexpr std::size_t kSide = tree::kGridSide;

  using Draw = std::function<index::OccupancyIndex(std::size_t x, std::size_t y)>;

  [[nodiscard]] index::OccupancyIndex at(std::size_t x, std::size_t y) const {
    return cells_[y * kSide + x];
  }
  [[nodiscard]] const std::vector<index::OccupancyIndex>& cells() const { return cells_; }

  void set(std::size_t x, std::size_t y, index::OccupancyIndex index) {
    cells_[y * kSide + x] = index;
  }

  GridDrawing& fill(std::size_t x, std::size_t y, std::size_t width, std::size_t height,
                    const Draw& draw) {
    for (std::size_t row = y; row < y + height; ++row) {
      for (std::size_t column = x; column < x + width; ++column) {
        set(column, row, draw(column, row));
      }
    }
    return *this;
  }

  GridDrawing& fill(const Draw& draw) { return fill(0, 0, kSide, kSide, draw); }

 private:
  std::vector<index::OccupancyIndex> cells_ = std::vector<index::OccupancyIndex>(kSide * kSide);
};

struct NamedGrid {
  std::string name;
  GridDrawing grid;
};

// Beams from the middle: 1D cells of free space up to a hit, as a scanner leaves them.
inline GridDrawing fan_of_beams(Random& random, int beams) {
  GridDrawing grid;
  for (int beam = 0; beam < beams; ++beam) {
    const std::int32_t end_x = random.between(-511, 511);
    const std::int32_t end_y = random.between(-511, 511);
    constexpr std::int32_t kSteps = 512;
    for (std::int32_t step = 0; step <= kSteps; ++step) {
      const std::int32_t column = 512 + end_x * step / kSteps;
      const std::int32_t row = 512 + end_y * step / kSteps;
      const auto x = static_cast<std::size_t>(column);
      const auto y = static_cast<std::size_t>(row);
      const auto evidence = static_cast<index::OccupancyIndex>(step == kSteps ? 2 : -14);
      grid.set(x, y, index::sat_add(grid.at(x, y), evidence));
    }
  }
  return grid;
}

// Blocks of random place, size and index, drawn over one another, inside of a square.
inline GridDrawing random_blocks(Random& random, int blocks, std::size_t square) {
  GridDrawing grid;
  for (int block = 0; block < blocks; ++block) {
    const std::size_t side = std::size_t{1} << random.below(8);
    const std::size_t x = random.below(square / side) * side;
    const std::size_t y = random.below(square / side) * side;
    const auto index = static_cast<index::OccupancyIndex>(random.between(-2, 2));
    grid.fill(x, y, side, side, [index](std::size_t, std::size_t) { return index; });
  }
  return grid;
}

}  // namespace iog::tests
