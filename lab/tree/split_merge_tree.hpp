// The 2^d-tree of the thesis, section 3.5: updated cell by cell, with its operations split and
// merge. A quadtree for d = 2, an octree for d = 3.
//
// It is the reference for two questions: what the leaves of a grid are, and what it costs to keep a
// tree up to date at every cell. Unlike the thesis's tree it has no pointers and no heap. Its nodes
// are numbers in a pool, and an update that finds no room is refused and counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "index/occupancy_index.hpp"
#include "lab/tree/block.hpp"
#include "lab/tree/node_pool.hpp"
#include "require/require.hpp"

namespace iog::tree {

enum class Update : std::uint8_t {
  kDone,
  kNoRoom,  // the tree is as it was
};

// kMaxDepth: MaxDepth(N) of definition 3.5.1; the grid has 2^kMaxDepth cells along each dimension.
// kMaxSplits: the most nodes with children at a time. A split in progress counts, so an update
// needs up to kMaxDepth of them even where merging returns them at once. With max_splits() of them
// no update is ever refused.
template <std::size_t kDimension, std::uint32_t kMaxDepth, std::size_t kMaxSplits>
class SplitMergeTree {
 public:
  using Cell = tree::Cell<kDimension>;

  static constexpr std::uint32_t kChildren = 1U << kDimension;

  // Splits of a grid in which no two cells are alike: every block larger than a cell.
  static constexpr std::size_t max_splits() {
    std::size_t splits = 0;
    for (std::uint32_t depth = 0; depth < kMaxDepth; ++depth) {
      splits = splits * kChildren + 1;
    }
    return splits;
  }

  // One leaf: the whole grid is unknown.
  void clear() {
    nodes_.clear();
    refused_ = 0;
  }

  // Sets the index of a cell. It splits the leaf that holds the cell while condition (3.46) holds,
  // then merges upwards while (3.47) does.
  [[nodiscard]] Update set(const Cell& cell, index::OccupancyIndex index) {
    Path path = path_to(cell);
    if (nodes_.index(path.last()) == index) {
      return Update::kDone;
    }
    if (nodes_.free() < kMaxDepth - path.depth) {
      ++refused_;
      return Update::kNoRoom;
    }
    while (path.depth < kMaxDepth) {
      nodes_.give_children(path.last());
      descend(path);
    }
    nodes_.set_index(path.last(), index);
    merge(path);
    return Update::kDone;
  }

  // The fusion of a cell with new evidence: a saturated sum (thesis section 3.4.2).
  [[nodiscard]] Update add(const Cell& cell, index::OccupancyIndex evidence) {
    return set(cell, index::sat_add(leaf_at(cell).index, evidence));
  }

  // The leaf that holds a cell.
  [[nodiscard]] Leaf<kDimension> leaf_at(const Cell& cell) const {
    const Path path = path_to(cell);
    const std::uint32_t side_log2 = kMaxDepth - path.depth;
    Leaf<kDimension> leaf{{cell, side_log2}, nodes_.index(path.last())};
    for (std::uint32_t& low : leaf.block.corner) {
      low = low >> side_log2 << side_log2;
    }
    return leaf;
  }

  // Calls visit(Leaf) for every leaf, in Morton order.
  template <typename Visit>
  void for_each_leaf(Visit&& visit) const {
    constexpr std::uint32_t kCells = 1U << (kDimension * kMaxDepth);
    for (std::uint32_t place = 0; place < kCells;) {
      const Leaf<kDimension> leaf = leaf_at(morton_cell<kDimension>(place));
      visit(leaf);
      place += 1U << (kDimension * leaf.block.side_log2);
    }
  }

  // As table 4.7 counts them: a split turns one leaf into 2^d, and every node is a leaf or split.
  [[nodiscard]] std::size_t leaves() const { return 1 + nodes_.used() * (kChildren - 1); }
  [[nodiscard]] std::size_t nodes() const { return 1 + nodes_.used() * kChildren; }

  // Updates that found no room since clear().
  [[nodiscard]] std::size_t refused() const { return refused_; }

 private:
  static_assert(kDimension >= 1 && kMaxDepth >= 1);
  static_assert(kDimension * kMaxDepth < 32);

  // The nodes from the root towards a cell.
  struct Path {
    std::uint32_t place = 0;  // of the cell
    std::uint32_t depth = 0;  // of the last node
    std::array<Node, kMaxDepth + 1> nodes{};

    [[nodiscard]] Node last() const { return nodes[depth]; }
  };

  // Down to the leaf.
  [[nodiscard]] Path path_to(const Cell& cell) const {
    for (const std::uint32_t coordinate : cell) {
      require(coordinate >> kMaxDepth == 0);
    }
    Path path;
    path.place = morton_place(cell, kMaxDepth);
    while (!nodes_.is_leaf(path.last())) {
      descend(path);
    }
    return path;
  }

  void descend(Path& path) const {
    const std::uint32_t side_log2 = kMaxDepth - 1 - path.depth;
    const std::uint32_t number = path.place >> (kDimension * side_log2) & (kChildren - 1);
    const Node child = nodes_.child(path.last(), number);
    ++path.depth;
    path.nodes[path.depth] = child;
  }

  // Algorithm 2, up from the last node of a path, which is a leaf.
  void merge(Path& path) {
    while (path.depth > 0 && are_equal_leaves(path.nodes[path.depth - 1])) {
      const index::OccupancyIndex index = nodes_.index(path.last());
      --path.depth;
      nodes_.take_children(path.last());
      nodes_.set_index(path.last(), index);
    }
  }

  // Condition (3.47) for a node with children.
  [[nodiscard]] bool are_equal_leaves(Node parent) const {
    const index::OccupancyIndex first = nodes_.index(nodes_.child(parent, 0));
    for (std::uint32_t number = 0; number < kChildren; ++number) {
      const Node child = nodes_.child(parent, number);
      if (!nodes_.is_leaf(child) || nodes_.index(child) != first) {
        return false;
      }
    }
    return true;
  }

  std::size_t refused_ = 0;
  NodePool<kChildren, kMaxSplits> nodes_;
};

}  // namespace iog::tree
