// A quadtree with the memory for its leaves, built from a drawing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "lab/tree/grid_drawing.hpp"
#include "lab/tree/linear_quadtree.hpp"
#include "lab/tree/quadtree_builder.hpp"

namespace iog::tests {

using TileBytes = std::array<std::byte, tree::kTileCells>;

inline TileBytes tile_of(const GridDrawing& grid, std::size_t tile_x, std::size_t tile_y) {
  TileBytes bytes{};
  for (std::size_t cell = 0; cell < bytes.size(); ++cell) {
    const std::size_t x = tile_x * tree::kTileSide + cell % tree::kTileSide;
    const std::size_t y = tile_y * tree::kTileSide + cell / tree::kTileSide;
    bytes[cell] = static_cast<std::byte>(grid.at(x, y));
  }
  return bytes;
}

inline bool is_known(const TileBytes& tile) {
  return std::ranges::any_of(tile, [](std::byte cell) { return cell != std::byte{}; });
}

class BuiltQuadtree {
 public:
  explicit BuiltQuadtree(std::size_t leaf_bytes = tree::kWorstLeafBytes)
      : memory_(leaf_bytes), tree_(memory_) {}

  // Delivers the tiles in which something is known, row by row.
  BuiltQuadtree& build(const GridDrawing& grid) {
    tree::QuadtreeBuilder builder(tree_);
    builder.begin();
    for (std::size_t y = 0; y < tree::kTilesPerSide; ++y) {
      for (std::size_t x = 0; x < tree::kTilesPerSide; ++x) {
        const TileBytes tile = tile_of(grid, x, y);
        if (is_known(tile) && builder.add(x, y, tile) == tree::TileFate::kNoRoom) {
          ++refused_;
        }
      }
    }
    builder.finish();
    return *this;
  }

  [[nodiscard]] const tree::LinearQuadtree& operator*() const { return tree_; }
  [[nodiscard]] const tree::LinearQuadtree* operator->() const { return &tree_; }
  [[nodiscard]] tree::LinearQuadtree& tree() { return tree_; }
  [[nodiscard]] std::size_t refused() const { return refused_; }

 private:
  std::vector<std::byte> memory_;
  tree::LinearQuadtree tree_;
  std::size_t refused_ = 0;
};

inline BuiltQuadtree quadtree_of(const GridDrawing& grid) {
  BuiltQuadtree built;
  built.build(grid);
  return built;
}

}  // namespace iog::tests
