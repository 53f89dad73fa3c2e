// Splits and merges, counted on frames of which they are known: thesis algorithm 2 and conditions
// 3.46 and 3.47 on a grid of 1024 by 1024 cells, ten halvings deep.
#include <cstdint>
#include <vector>

#include "gtest/gtest.h"

#include "lab/experiments/quadtree/updates.hpp"

namespace iog::lab {
namespace {

// Free before the scan point, occupied in its cell.
ByStep<std::int32_t> values() {
  ByStep<std::int32_t> values{};
  values[slot_of(-1)] = -2;
  values[slot_of(0)] = 2;
  values[slot_of(1)] = 1;
  return values;
}

TreeUpdates count(const std::vector<CellEvidence>& cells) {
  return TreeFusion().fuse({.cells = cells, .hits = {}}, values());
}

TEST(TreeUpdates, TheFirstCellSplitsTheWholeGridDownToIt) {
  const TreeUpdates counted = count({{.cell = 700, .step = 0}});
  EXPECT_EQ(counted.updates, 1U);
  EXPECT_EQ(counted.splits, 10U);
  EXPECT_EQ(counted.merges, 0U);
  EXPECT_EQ(counted.leaves, 31U);
}

TEST(TreeUpdates, ItsNeighbourFindsTheBlockSplit) {
  const TreeUpdates counted = count({{.cell = 700, .step = 0}, {.cell = 701, .step = 0}});
  EXPECT_EQ(counted.updates, 2U);
  EXPECT_EQ(counted.splits, 10U);
}

TEST(TreeUpdates, WhatIsTakenBackIsMergedToTheRoot) {
  const TreeUpdates counted = count({{.cell = 700, .step = 0}, {.cell = 700, .step = -1}});
  EXPECT_EQ(counted.updates, 2U);
  EXPECT_EQ(counted.splits, 10U);
  EXPECT_EQ(counted.merges, 10U);
  EXPECT_EQ(counted.leaves, 1U);
}

// Neither an index of 0 nor a saturated sum changes a cell.
TEST(TreeUpdates, WhatChangesNothingIsNoUpdate) {
  std::vector<CellEvidence> cells(100, {.cell = 700, .step = 0});
  cells.push_back({.cell = 3, .step = 5});
  const TreeUpdates counted = count(cells);
  EXPECT_EQ(counted.updates, 64U);  // 2, 4, ... 126, 127
  EXPECT_EQ(counted.splits, 10U);
}

TEST(TreeUpdates, AFrameBeginsFromNothing) {
  TreeFusion fusion;
  const FrameEvidence frame{.cells = {{.cell = 700, .step = 0}}, .hits = {}};
  static_cast<void>(fusion.fuse(frame, values()));
  const TreeUpdates counted = fusion.fuse(frame, values());
  EXPECT_EQ(counted.splits, 10U);
  EXPECT_EQ(counted.leaves, 31U);
  EXPECT_EQ(counted.differing_cells, 0U);
}

}  // namespace
}  // namespace iog::lab
