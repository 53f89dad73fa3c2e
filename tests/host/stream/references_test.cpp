#include "stream/references.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

namespace iog::stream {
namespace {

std::array<std::byte, tile_coding::kTileBytes> tile_of(int value) {
  std::array<std::byte, tile_coding::kTileBytes> cells{};
  cells.fill(static_cast<std::byte>(value));
  return cells;
}

TEST(References, KeepTheLastOfEachTile) {
  const auto references = std::make_unique<References>();
  EXPECT_FALSE(references->find(3).has_value());
  references->keep(3, tile_of(1), 10, 5);
  references->keep(4, tile_of(2), 11, 6);
  references->keep(3, tile_of(5), 12, 7);
  const auto kept = references->find(3);
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(kept->frame_number, 12U);
  EXPECT_TRUE(std::ranges::equal(kept->cells, tile_of(5)));
  references->forget();
  EXPECT_FALSE(references->find(3).has_value());
  EXPECT_FALSE(references->find(4).has_value());
}

// Whoever has had eight frames needs none before them, also when frame numbers wrap.
TEST(References, NoneIsUsableThatIsOlderThanSevenFrames) {
  for (const std::uint32_t first : {100U, 0xFFFFFFFCU}) {
    for (std::size_t tile = 0; tile < 16; ++tile) {
      const auto references = std::make_unique<References>();
      references->keep(tile, tile_of(1), first, 5);
      for (std::uint32_t age = 0; age < 20; ++age) {
        if (references->usable(tile, first + age)) {
          ASSERT_LE(age, 7U);
        }
      }
    }
  }
}

// In each of eight frames in a row an eighth of the tiles has to stand by itself.
TEST(References, TilesTakeTurnsToStandByThemselves) {
  const auto references = std::make_unique<References>();
  for (std::uint32_t frame = 50; frame < 58; ++frame) {
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      references->keep(tile, tile_of(1), frame - 1, 5);
    }
    std::size_t alone = 0;
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      alone += references->usable(tile, frame) ? 0U : 1U;
    }
    EXPECT_EQ(alone, geometry::kTileCount / 8);
  }
}

// 35 of 40 bytes are seven eighths.
TEST(References, NoneIsUsableSinceWhichTooMuchHasChanged) {
  const auto references = std::make_unique<References>();
  references->keep(3, tile_of(1), 10, 40);
  references->note_changes(3, 35);
  EXPECT_TRUE(references->usable(3, 12).has_value());
  references->note_changes(3, 36);
  EXPECT_FALSE(references->usable(3, 12).has_value());
  EXPECT_TRUE(references->find(3).has_value()) << "what was sent refers to it";
  references->keep(3, tile_of(2), 12, 40);
  EXPECT_TRUE(references->usable(3, 14).has_value());
}

}  // namespace
}  // namespace iog::stream
