// The two quadtrees of one grid, held against the array and against each other: the linear one,
// built bottom-up, and the reference, which splits and merges cell by cell (thesis section 3.5).
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "lab/experiments/fused_drive.hpp"
#include "lab/tree/linear_quadtree.hpp"
#include "lab/tree/split_merge_tree.hpp"

namespace iog::lab {

// With room for any grid.
using SplitMergeQuadtree =
    tree::SplitMergeTree<2, tree::kGridSideLog2,
                         tree::SplitMergeTree<2, tree::kGridSideLog2, 0>::max_splits()>;

struct QuadtreeSize {
  std::size_t leaves = 0;
  std::size_t nodes = 0;
  std::size_t linear_bytes = 0;
  std::size_t reference_bytes = 0;   // a number and an index for each node
  std::size_t differing_cells = 0;   // of the linear tree, from the array
  std::size_t differing_leaves = 0;  // of the trees, from each other
};

class QuadtreePair {
 public:
  QuadtreePair();

  // Builds both trees of a grid and compares them. std::logic_error with the grid's name if one has
  // no room for it.
  QuadtreeSize build(GridCells cells, const std::string& name);

 private:
  void build_linear(GridCells cells);
  void build_reference(GridCells cells);

  std::vector<std::byte> leaf_memory_;
  std::unique_ptr<tree::LinearQuadtree> linear_;
  std::unique_ptr<SplitMergeQuadtree> reference_;
};

// How many cells are not in exactly one of a tree's leaves or have another index there than in the
// array.
[[nodiscard]] std::size_t differing_cells(const std::vector<tree::Leaf<2>>& leaves,
                                          GridCells cells);

}  // namespace iog::lab
