// The nodes of a 2^d-tree, in a fixed number of places: numbers instead of pointers, no heap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "index/occupancy_index.hpp"
#include "require/require.hpp"

namespace iog::tree {

// A node's number. The root is 0 and nobody's child, so 0 also says "no node".
using Node = std::uint32_t;
inline constexpr Node kRoot = 0;
inline constexpr Node kNoNode = 0;

// The root, and room for kFamilies families of kSiblings nodes. The nodes of a family have numbers
// in a row. Five bytes a node: the thesis's have nine, because each has two pointers.
template <std::size_t kSiblings, std::size_t kFamilies>
class NodePool {
 public:
  // Only the root is left, a leaf of unknown cells.
  void clear() {
    first_child_[kRoot] = kNoNode;
    index_[kRoot] = index::kUnknown;
    used_ = 0;
    fresh_ = 0;
    returned_ = kNoNode;
  }

  // Families in use, and those that can still be had.
  [[nodiscard]] std::size_t used() const { return used_; }
  [[nodiscard]] std::size_t free() const { return kFamilies - used_; }

  [[nodiscard]] bool is_leaf(Node node) const { return first_child_[node] == kNoNode; }
  [[nodiscard]] Node child(Node node, std::uint32_t number) const {
    return first_child_[node] + number;
  }
  [[nodiscard]] index::OccupancyIndex index(Node node) const { return index_[node]; }
  void set_index(Node node, index::OccupancyIndex index) { index_[node] = index; }

  // Gives a leaf children, which take its index; its own is 0 from now on. Only if free() > 0.
  void give_children(Node leaf) {
    require(is_leaf(leaf) && free() > 0);
    const Node first = take_family();
    for (Node child = first; child < first + kSiblings; ++child) {
      first_child_[child] = kNoNode;
      index_[child] = index_[leaf];
    }
    first_child_[leaf] = first;
    index_[leaf] = index::kUnknown;
  }

  // Takes the children from a node, which is a leaf again. The children are leaves.
  void take_children(Node node) {
    const Node first = first_child_[node];
    require(first != kNoNode);
    first_child_[first] = returned_;
    returned_ = first;
    first_child_[node] = kNoNode;
    --used_;
  }

 private:
  // Families that were given back form a chain through their first node. The others were never
  // used.
  Node take_family() {
    ++used_;
    if (returned_ != kNoNode) {
      const Node first = returned_;
      returned_ = first_child_[first];
      return first;
    }
    return static_cast<Node>(1 + kSiblings * fresh_++);
  }

  static constexpr std::size_t kNodes = 1 + kSiblings * kFamilies;
  static_assert(kNodes - 1 <= UINT32_MAX);

  std::size_t used_ = 0;
  std::size_t fresh_ = 0;
  Node returned_ = kNoNode;
  std::array<Node, kNodes> first_child_{};
  std::array<index::OccupancyIndex, kNodes> index_{};
};

}  // namespace iog::tree
