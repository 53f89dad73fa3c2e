// Builds a linear quadtree from the tiles of a frame's grid, bottom-up: cells to blocks of a tile,
// uniform tiles to larger blocks.
//
//   builder.begin();
//   builder.add(tile_x, tile_y, cells);  // every tile in which something is known, in any order
//   builder.finish();
//
// The work of a frame is bounded: each tile costs at most what a checkerboard does, and there are
// 341 blocks of tiles.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lab/tree/linear_quadtree.hpp"
#include "lab/tree/tile_shape.hpp"

namespace iog::tree {

enum class TileFate : std::uint8_t {
  kAdded,
  kNoRoom,  // less memory is left than the leaves of any tile need; it reads as unknown
};

class QuadtreeBuilder {
 public:
  // tree outlives the builder. From begin() to finish() it is not to be read.
  explicit QuadtreeBuilder(LinearQuadtree& tree) : tree_(&tree) {}

  // Makes every tile unknown.
  void begin();

  // Adds the cells of a tile; each tile at most once between begin() and finish().
  [[nodiscard]] TileFate add(std::size_t tile_x, std::size_t tile_y, TileCells cells);

  // Merges uniform tiles. The tree is complete unless it has lost tiles.
  void finish();

 private:
  LinearQuadtree* tree_;
};

}  // namespace iog::tree
