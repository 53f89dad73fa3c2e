// What it takes to fuse a frame in the tree itself, as the thesis does: the splits and merges of
// every single update.
#pragma once

#include <memory>
#include <string>

#include "lab/evidence/fusion_rules.hpp"
#include "lab/experiments/quadtree_pair.hpp"

namespace iog::lab {

// Of some frames.
struct TreeUpdates {
  double frames = 0;
  double updates = 0;  // measurements of cells that change something
  double splits = 0;   // nodes that got children
  double merges = 0;   // nodes that lost them
  double leaves = 0;   // at the end of each frame
};

class TreeFusion {
 public:
  TreeFusion();

  // Adds the frame's evidence, in its order, to a tree of unknown cells. std::logic_error with the
  // name if a cell at the end is not that of the array fused by the same sum.
  void add(const FrameEvidence& evidence, const ByStep<std::int32_t>& values,
           const std::string& name);

  [[nodiscard]] const TreeUpdates& counted() const { return counted_; }

 private:
  std::unique_ptr<SplitMergeQuadtree> tree_;
  TreeUpdates counted_;
};

}  // namespace iog::lab
