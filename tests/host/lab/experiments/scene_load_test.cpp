#include "lab/experiments/output_rates/scene_load.hpp"

#include <vector>

#include "gtest/gtest.h"

#include "lab/experiments/target_drive.hpp"

namespace iog::lab {
namespace {

constexpr std::size_t kSide = 1024;

// A grid of zeros to draw on.
class LeavesTest : public testing::Test {
 protected:
  void fill(std::size_t x, std::size_t y, std::size_t side, index::OccupancyIndex index) {
    for (std::size_t row = y; row < y + side; ++row) {
      for (std::size_t column = x; column < x + side; ++column) {
        cells_[row * kSide + column] = index;
      }
    }
  }

  [[nodiscard]] std::size_t leaves() const {
    return count_leaves(std::span(cells_).first<geometry::kCellCount>());
  }

 private:
  std::vector<index::OccupancyIndex> cells_ = std::vector<index::OccupancyIndex>(kSide * kSide);
};

TEST_F(LeavesTest, AGridOfOneIndexIsOneLeaf) {
  EXPECT_EQ(leaves(), 1U);
  fill(0, 0, kSide, -127);
  EXPECT_EQ(leaves(), 1U);
}

TEST_F(LeavesTest, AQuadrantIsOneOfFour) {
  fill(512, 512, 512, 127);
  EXPECT_EQ(leaves(), 4U);
}

// Ten times a block is split in four, down to the cell: 3 leaves beside it each time, and itself.
TEST_F(LeavesTest, ACellSplitsEveryBlockAroundIt) {
  fill(700, 3, 1, 2);
  EXPECT_EQ(leaves(), 31U);
}

// Four cells that are one block need a split fewer than the first alone; four that lie across the
// middle of the grid share but the root.
TEST_F(LeavesTest, OnlyBlocksOfTheTreeAreMerged) {
  fill(700, 2, 2, 2);
  EXPECT_EQ(leaves(), 28U);
  fill(700, 2, 2, 0);
  fill(511, 511, 2, 2);
  EXPECT_EQ(leaves(), 1U + 3U + 4U * 9U * 3U);
}

TEST_F(LeavesTest, ACheckerboardHasNoBlocks) {
  for (std::size_t y = 0; y < kSide; ++y) {
    for (std::size_t x = y % 2; x < kSide; x += 2) {
      fill(x, y, 1, -14);
    }
  }
  EXPECT_EQ(leaves(), kSide * kSide);
}

// An index that takes four bytes is told from another by all of them.
TEST_F(LeavesTest, OfWideIndexesAreTheSame) {
  std::vector<std::int32_t> wide(kSide * kSide, -736'109);
  const auto cells = std::span<const std::int32_t>(wide).first<geometry::kCellCount>();
  EXPECT_EQ(count_leaves(cells), 1U);
  wide[3 * kSide + 700] += 256;
  EXPECT_EQ(count_leaves(cells), 31U);
}

// Thesis table 4.7: 3.75 cells a leaf and 2.81 a node, on the drive that is compared with it.
TEST(SceneLoad, OfTheRingRoadIsThatOfTheThesis) {
  const SceneLoad load = load_of("ring_road", kTargetSeed, kTargetSeconds);
  EXPECT_NEAR(load.cells_per_leaf, 3.75, 0.15);
  EXPECT_NEAR(load.cells_per_node, 2.81, 0.12);
}

// A street between houses has less than half of the leaves.
TEST(SceneLoad, OfTheCityIsLighter) {
  EXPECT_GT(load_of("city", kTargetSeed, 1).cells_per_leaf, 2 * 3.75);
}

}  // namespace
}  // namespace iog::lab
