#include "lab/experiments/quadtree/pair.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "lab/tree/quadtree_builder.hpp"

namespace iog::lab {
namespace {

using Leaves = std::vector<tree::Leaf<2>>;
using Tile = std::array<std::byte, tree::kTileCells>;

static_assert(tree::kGridSide == geometry::kCellsPerSide);

Tile tile_of(GridCells cells, std::size_t tile_x, std::size_t tile_y) {
  Tile tile{};
  for (std::size_t row = 0; row < tree::kTileSide; ++row) {
    const std::size_t first =
        (tile_y * tree::kTileSide + row) * geometry::kCellsPerSide + tile_x * tree::kTileSide;
    std::ranges::transform(cells.subspan(first, tree::kTileSide),
                           tile.begin() + static_cast<std::ptrdiff_t>(row * tree::kTileSide),
                           [](index::OccupancyIndex index) { return std::byte(index); });
  }
  return tile;
}

template <typename Tree>
Leaves leaves_of(const Tree& tree) {
  Leaves leaves;
  leaves.reserve(tree.leaves());
  tree.for_each_leaf([&leaves](const tree::Leaf<2>& leaf) { leaves.push_back(leaf); });
  return leaves;
}

// Both list their leaves in Morton order.
std::size_t differing_leaves(const Leaves& ours, const Leaves& reference) {
  const std::size_t both = std::min(ours.size(), reference.size());
  std::size_t differing = std::max(ours.size(), reference.size()) - both;
  for (std::size_t i = 0; i < both; ++i) {
    differing += ours[i] == reference[i] ? 0U : 1U;
  }
  return differing;
}

}  // namespace

// -128 is no index, so it says that no leaf was drawn there yet, or two.
std::size_t differing_cells(const Leaves& leaves, GridCells cells) {
  constexpr std::int8_t kNoIndex = -128;
  std::vector<std::int8_t> drawn(cells.size(), kNoIndex);
  std::vector<bool> is_drawn(cells.size());
  for (const auto& [block, index] : leaves) {
    const std::size_t side = std::size_t{1} << block.side_log2;
    for (std::size_t row = 0; row < side; ++row) {
      const std::size_t first = (block.corner[1] + row) * geometry::kCellsPerSide + block.corner[0];
      for (std::size_t cell = first; cell < first + side; ++cell) {
        drawn[cell] = is_drawn[cell] ? kNoIndex : index;
        is_drawn[cell] = true;
      }
    }
  }
  std::size_t differing = 0;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    differing += drawn[cell] == cells[cell] ? 0U : 1U;
  }
  return differing;
}

QuadtreePair::QuadtreePair()
    : leaf_memory_(tree::kWorstLeafBytes),
      linear_(std::make_unique<tree::LinearQuadtree>(leaf_memory_)),
      reference_(std::make_unique<SplitMergeQuadtree>()) {}

// As the firmware would: the tiles in which something is known.
void QuadtreePair::build_linear(GridCells cells) {
  tree::QuadtreeBuilder builder(*linear_);
  builder.begin();
  for (std::size_t y = 0; y < tree::kTilesPerSide; ++y) {
    for (std::size_t x = 0; x < tree::kTilesPerSide; ++x) {
      const Tile tile = tile_of(cells, x, y);
      if (std::ranges::any_of(tile, [](std::byte cell) { return cell != std::byte{}; })) {
        static_cast<void>(builder.add(x, y, tile));  // lost_tiles() counts what finds no room
      }
    }
  }
  builder.finish();
}

void QuadtreePair::build_reference(GridCells cells) {
  reference_->clear();
  for (std::uint32_t y = 0; y < tree::kGridSide; ++y) {
    for (std::uint32_t x = 0; x < tree::kGridSide; ++x) {
      static_cast<void>(reference_->set({x, y}, cells[y * geometry::kCellsPerSide + x]));
    }
  }
}

QuadtreeSize QuadtreePair::build(GridCells cells, const std::string& name) {
  build_linear(cells);
  build_reference(cells);
  if (linear_->lost_tiles() > 0 || reference_->refused() > 0) {
    throw std::logic_error("a quadtree has no room for " + name);
  }
  const Leaves leaves = leaves_of(*linear_);
  constexpr std::size_t kNodeBytes = sizeof(tree::Node) + sizeof(index::OccupancyIndex);
  return {.leaves = linear_->leaves(),
          .nodes = linear_->nodes(),
          .linear_bytes = linear_->used_bytes(),
          .reference_bytes = kNodeBytes * linear_->nodes(),
          .differing_cells = differing_cells(leaves, cells),
          .differing_leaves = differing_leaves(leaves, leaves_of(*reference_))};
}

}  // namespace iog::lab
