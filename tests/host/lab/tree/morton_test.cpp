// The Morton order of cells, by its definition: at every size of block the cells of the four (or
// eight) parts follow one another, x first.
#include <gtest/gtest.h>

#include "lab/tree/block.hpp"

namespace iog::tree {
namespace {

TEST(Morton, InterleavesTheBitsOfTheCoordinates) {
  EXPECT_EQ(morton_place<2>({0b1011, 0b0110}, 4), 0b01'10'11'01U);
  EXPECT_EQ(morton_place<3>({1, 0, 1}, 1), 0b101U);
  EXPECT_EQ(morton_place<1>({37}, 6), 37U);
}

TEST(Morton, ACellIsFoundAtItsPlace) {
  for (std::uint32_t place = 0; place < 4096; ++place) {
    EXPECT_EQ(morton_place<2>(morton_cell<2>(place), 6), place);
    EXPECT_EQ(morton_place<3>(morton_cell<3>(place), 4), place);
  }
}

// Of the k-th bit of a place, k mod d says the axis and k div d the bit.
TEST(Morton, EveryBitOfACoordinateHasItsPlace) {
  for (std::uint32_t bit = 0; bit < 10; ++bit) {
    EXPECT_EQ(morton_place<2>({1U << bit, 0}, 16), 1U << (2 * bit));
    EXPECT_EQ(morton_place<2>({0, 1U << bit}, 16), 1U << (2 * bit + 1));
    EXPECT_EQ(morton_place<3>({0, 1U << bit, 0}, 10), 1U << (3 * bit + 1));
    EXPECT_EQ(morton_cell<2>(1U << (2 * bit + 1)), (Cell<2>{0, 1U << bit}));
  }
  EXPECT_EQ(morton_place<2>({0xFFFF, 0xFFFF}, 16), 0xFFFFFFFFU);
  EXPECT_EQ(morton_cell<2>(0xFFFFFFFFU), (Cell<2>{0xFFFF, 0xFFFF}));
}

TEST(Morton, TheHighestCellIsTheLast) {
  EXPECT_EQ(morton_place<2>({1023, 1023}, 10), (1U << 20) - 1);
  EXPECT_EQ((morton_cell<2>((1U << 20) - 1)), (Cell<2>{1023, 1023}));
}

}  // namespace
}  // namespace iog::tree
