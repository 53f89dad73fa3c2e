#include "stream/grid_hash.hpp"

#include <array>
#include <gtest/gtest.h>

namespace iog::stream {
namespace {

// tests/e2e/protected_message.py: crc32_p4(bytes([0, 4, 0, 5]) + bytes([3]) * 1024)
TEST(GridHash, IsTheCrcOfPlaceAndCells) {
  std::array<std::byte, tile_coding::kTileBytes> tile{};
  tile.fill(std::byte{3});
  GridHash hash;
  EXPECT_EQ(hash.value(), 0U);
  hash.add(5 * geometry::kTilesPerSide + 4, tile);
  EXPECT_EQ(hash.value(), 0xB68EC44CU);
  GridHash of_long(geometry::Grid{.columns = 2048, .rows = 512, .origin_row = 0});
  of_long.add(5 * 64 + 4, tile);
  EXPECT_EQ(of_long.value(), hash.value());
}

}  // namespace
}  // namespace iog::stream
