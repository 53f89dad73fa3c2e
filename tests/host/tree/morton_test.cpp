// The Morton order of cells, by its definition: at every size of block the cells of the four (or
// eight) parts follow one another, x first.
#include <gtest/gtest.h>

#include "tree/block.hpp"

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

TEST(Morton, TheHighestCellIsTheLast) {
  EXPECT_EQ(morton_place<2>({1023, 1023}, 10), (1U << 20) - 1);
  EXPECT_EQ((morton_cell<2>((1U << 20) - 1)), (Cell<2>{1023, 1023}));
}

}  // namespace
}  // namespace iog::tree
