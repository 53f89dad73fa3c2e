#include "lab/experiments/output_rates/scene_load.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "lab/experiments/experiments.hpp"
#include "lab/experiments/fused_drive.hpp"
#include "lab/experiments/target_drive.hpp"

namespace iog::lab {
namespace {

// A block is the index of all its cells, or says that there are several.
template <typename Block>
constexpr Block kMixed = std::numeric_limits<Block>::min();

// Blocks of twice the side, from a square of `side` times `side` blocks.
template <typename Block>
std::vector<Block> merge(const std::vector<Block>& blocks, std::size_t side) {
  std::vector<Block> larger;
  larger.reserve(blocks.size() / 4);
  for (std::size_t y = 0; y < side; y += 2) {
    const Block* const low = &blocks[y * side];
    const Block* const high = low + side;
    for (std::size_t x = 0; x < side; x += 2) {
      const Block first = low[x];
      const bool is_one = first == low[x + 1] && first == high[x] && first == high[x + 1];
      larger.push_back(is_one ? first : kMixed<Block>);
    }
  }
  return larger;
}

// The root is a leaf, and every mixed block has four parts in its place: three leaves more.
template <typename Block>
std::size_t leaves_of(std::span<const Block> cells) {
  std::vector<Block> blocks(cells.begin(), cells.end());
  std::size_t leaves = 1;
  for (std::size_t side = geometry::kCellsPerSide; side > 1; side /= 2) {
    blocks = merge(blocks, side);
    leaves += 3 * static_cast<std::size_t>(std::ranges::count(blocks, kMixed<Block>));
  }
  return leaves;
}

// Sums over frames.
struct Census {
  double frames = 0;
  double known = 0;
  double leaves = 0;
  double nodes = 0;

  void add(GridCells cells) {
    const std::size_t leaves_here = count_leaves(cells);
    const std::size_t inner_here = (leaves_here - 1) / 3;
    ++frames;
    known += static_cast<double>(std::ranges::count_if(
        cells, [](index::OccupancyIndex index) { return index != index::kUnknown; }));
    leaves += static_cast<double>(leaves_here);
    nodes += static_cast<double>(leaves_here + inner_here);
  }
};

}  // namespace

// -128 never occurs (docs/model.md section 2).
std::size_t count_leaves(GridCells cells) { return leaves_of<index::OccupancyIndex>(cells); }

std::size_t count_leaves(std::span<const std::int32_t, geometry::kCellCount> cells) {
  return leaves_of<std::int32_t>(cells);
}

SceneLoad load_of(std::string_view scene, std::uint64_t seed, std::uint32_t seconds) {
  Census census;
  fuse_drive(scene, seed, seconds, vehicle::FusionRule::kBayes,
             [&census](GridCells cells) { census.add(cells); });
  const double all_cells = static_cast<double>(geometry::kCellCount) * census.frames;
  return {.known_cells = census.known / census.frames,
          .cells_per_leaf = all_cells / census.leaves,
          .cells_per_node = all_cells / census.nodes};
}

// Of the drives whose cost on the target is compared with the thesis.
Tables scene_load(const Input& /*input*/) {
  Table table("scene_load", {"scene", "rule", "known_cells", "cells_per_leaf", "cells_per_node"});
  for (const char* scene : kDrives) {
    const SceneLoad load = load_of(scene, kTargetSeed, kTargetSeconds);
    table.row(scene, "bayes", load.known_cells, load.cells_per_leaf, load.cells_per_node);
  }
  return {table};
}

}  // namespace iog::lab
