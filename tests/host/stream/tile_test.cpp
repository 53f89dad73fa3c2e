#include "stream/tile.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace iog::stream {
namespace {

// python3: zlib.crc32(bytes([0, 4, 0, 5]) + bytes([3]) * 1024)
TEST(GridHash, IsTheCrcOfPlaceAndCells) {
  std::array<std::byte, kTileBytes> tile{};
  tile.fill(std::byte{3});
  GridHash hash;
  EXPECT_EQ(hash.value(), 0U);
  hash.add(4, 5, tile);
  EXPECT_EQ(hash.value(), 0xAB6383F9U);
}

// Composed in place or written piece by piece, a message is the same: nothing of the tile before it
// is left.
TEST(TileMessage, IsTheMessageWrittenPieceByPiece) {
  Header header{.type = MessageType::kFrameEnd, .frame_number = 7, .vehicle_id = 8};
  TileMessage message(header);
  header.type = MessageType::kTile;
  for (const std::uint8_t n : std::array<std::uint8_t, 3>{0, 3, 31}) {
    const auto y = static_cast<std::uint16_t>(31 - n);
    message.set_tile(n, y);
    message.set_sequence(1000U * n);
    std::ranges::fill(message.cells(), static_cast<index::OccupancyIndex>(-n));

    header.sequence = 1000U * n;
    std::vector<std::byte> expected(kHeaderBytes + kTileHeaderBytes + kTileBytes,
                                    static_cast<std::byte>(-n));
    ASSERT_EQ(write_header(header, expected), kHeaderBytes);
    ASSERT_EQ(write_tile_header({.tile_x = n,
                                 .tile_y = y,
                                 .side_log2 = 5,
                                 .grid_width = 1024,
                                 .grid_height = 1024,
                                 .cell_mm = 100,
                                 .payload_bytes = 1024,
                                 .origin_x_mm = -51'200,
                                 .origin_y_mm = -51'200},
                                std::span(expected).subspan(kHeaderBytes)),
              kTileHeaderBytes);
    EXPECT_TRUE(std::ranges::equal(message.bytes(), expected));
    EXPECT_TRUE(std::ranges::equal(message.cell_bytes(),
                                   std::span(expected).subspan(kHeaderBytes + kTileHeaderBytes)));
  }
}

}  // namespace
}  // namespace iog::stream
