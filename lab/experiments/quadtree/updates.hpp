// What it takes to fuse a frame in the tree itself, as the thesis does: the splits and merges of
// every single update.
#pragma once

#include <cstdint>
#include <memory>

#include "lab/evidence/fusion_rules.hpp"
#include "lab/experiments/quadtree/pair.hpp"

namespace iog::lab {

inline constexpr double kDefaultEpsilon = 0.05;
inline constexpr std::int32_t kInt8Limit = 127;
inline constexpr std::int32_t kNoLimit = 1 << 30;

// Of a frame.
struct TreeUpdates {
  std::uint64_t updates = 0;          // measurements of cells that change something
  std::uint64_t splits = 0;           // nodes that got children
  std::uint64_t merges = 0;           // nodes that lost them
  std::uint64_t leaves = 0;           // at the end
  std::uint64_t differing_cells = 0;  // at the end, from the array fused by the same sum
};

class TreeFusion {
 public:
  TreeFusion();

  // Adds the frame's evidence, in its order, to a tree of unknown cells.
  [[nodiscard]] TreeUpdates fuse(const FrameEvidence& evidence, const ByStep<std::int32_t>& values);

 private:
  std::unique_ptr<SplitMergeQuadtree> tree_;
};

}  // namespace iog::lab
