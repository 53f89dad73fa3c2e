// The two quadtrees of one grid, held against the array and against each other: the linear one,
// built bottom-up, and the reference, which splits and merges cell by cell (thesis section 3.5).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "lab/experiments/fused_drive.hpp"
#include "tree/linear_quadtree.hpp"
#include "tree/split_merge_tree.hpp"

namespace iog::lab {

// With room for any grid.
using SplitMergeQuadtree =
    tree::SplitMergeTree<2, tree::kGridSideLog2,
                         tree::SplitMergeTree<2, tree::kGridSideLog2, 0>::max_splits()>;

struct QuadtreeSize {
  std::size_t leaves = 0;
  std::size_t nodes = 0;
  std::size_t linear_bytes = 0;
};

class QuadtreePair {
 public:
  QuadtreePair();

  // Builds both trees of a grid. std::logic_error with the grid's name if a cell of a tree is not
  // that of the array, or if the trees do not have the same leaves.
  QuadtreeSize build(GridCells cells, const std::string& name);

 private:
  void build_linear(GridCells cells);
  void build_reference(GridCells cells);

  std::vector<std::byte> leaf_memory_;
  std::unique_ptr<tree::LinearQuadtree> linear_;
  std::unique_ptr<SplitMergeQuadtree> reference_;
};

// Whether the leaves of a tree, each drawn over its block, are the array, cell for cell, and no
// cell is in two leaves or in none.
[[nodiscard]] bool are_cells_of(const std::vector<tree::Leaf<2>>& leaves, GridCells cells);

}  // namespace iog::lab
