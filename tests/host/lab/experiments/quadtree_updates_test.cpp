// Splits and merges, counted on frames of which they are known: thesis algorithm 2 and conditions
// 3.46 and 3.47 on a grid of 1024 by 1024 cells, ten halvings deep.
#include "lab/experiments/quadtree_updates.hpp"

#include <cstdint>
#include <vector>

#include "gtest/gtest.h"

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
  TreeFusion fusion;
  fusion.add({.cells = cells, .hits = {}}, values(), "the test's frame");
  return fusion.counted();
}

TEST(TreeUpdates, TheFirstCellSplitsTheWholeGridDownToIt) {
  const TreeUpdates counted = count({{.cell = 700, .step = 0}});
  EXPECT_EQ(counted.updates, 1);
  EXPECT_EQ(counted.splits, 10);
  EXPECT_EQ(counted.merges, 0);
  EXPECT_EQ(counted.leaves, 31);
}

TEST(TreeUpdates, ItsNeighbourFindsTheBlockSplit) {
  const TreeUpdates counted = count({{.cell = 700, .step = 0}, {.cell = 701, .step = 0}});
  EXPECT_EQ(counted.updates, 2);
  EXPECT_EQ(counted.splits, 10);
}

TEST(TreeUpdates, WhatIsTakenBackIsMergedToTheRoot) {
  const TreeUpdates counted = count({{.cell = 700, .step = 0}, {.cell = 700, .step = -1}});
  EXPECT_EQ(counted.updates, 2);
  EXPECT_EQ(counted.splits, 10);
  EXPECT_EQ(counted.merges, 10);
  EXPECT_EQ(counted.leaves, 1);
}

// Neither an index of 0 nor a saturated sum changes a cell.
TEST(TreeUpdates, WhatChangesNothingIsNoUpdate) {
  std::vector<CellEvidence> cells(100, {.cell = 700, .step = 0});
  cells.push_back({.cell = 3, .step = 5});
  const TreeUpdates counted = count(cells);
  EXPECT_EQ(counted.updates, 64);  // 2, 4, ... 126, 127
  EXPECT_EQ(counted.splits, 10);
}

TEST(TreeUpdates, FramesBeginFromNothingAndAddUp) {
  TreeFusion fusion;
  for (int frame = 0; frame < 2; ++frame) {
    fusion.add({.cells = {{.cell = 700, .step = 0}}, .hits = {}}, values(), "the test's frame");
  }
  EXPECT_EQ(fusion.counted().frames, 2);
  EXPECT_EQ(fusion.counted().splits, 20);
  EXPECT_EQ(fusion.counted().leaves, 62);
}

}  // namespace
}  // namespace iog::lab
