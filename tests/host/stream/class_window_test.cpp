// Tiles of classes and the header of their window, byte by byte as docs/spec.md 3.9 lists them.
#include "stream/class_window.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/bytes_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "stream/references.hpp"
#include "stream/tiles.hpp"
#include "tools/frames/tile_decoding.hpp"

namespace iog::stream {
namespace {

using tests::bytes_of;
using Bytes = std::vector<std::byte>;
using Tile = std::array<std::byte, tile_coding::kTileBytes>;

constexpr std::size_t kBodyOffset = protection::kProtectionBytes + kHeaderBytes;

const ClassWindow kWindow{.causes = kCauseLate | kCauseOverBudget,
                          .corner_a = -17,
                          .corner_b = 0x01020304,
                          .pose = {.x_mm = -2, .y_mm = 0x11121314, .heading = 0x81828384},
                          .sigma = {0x2122, 0x3132},
                          .slices = 5,
                          .slice_ms = 8,
                          .slices_begin_us = 0x4142434445464748,
                          .slices_end_us = 0x5152535455565758};

// Speaks of tiles 5 to 66 and carries 33, four frames old, and 65, which is of this frame.
Bytes some_body() {
  return bytes_of({
      0,    5,    0,    66,   0,    2,    5,    2,     // tiles, side, storage
      4,    0,    4,    0,    0,    100,  0,    0,     // 1024 by 1024 cells of 100 mm
      0,    0,    0,    0,    0,    0,    0,    0,     // their place is that of the window:
      0,    48,   0x00, 0x21,                          // its length, causes
      0xFF, 0xFF, 0xFF, 0xEF, 0x01, 0x02, 0x03, 0x04,  // corner
      0xFF, 0xFF, 0xFF, 0xFE, 0x11, 0x12, 0x13, 0x14,  // pose
      0x81, 0x82, 0x83, 0x84,                          // heading
      0x21, 0x22, 0x31, 0x32,                          // deviations
      5,    8,    0,    0,                             // slices
      0x41, 0x42, 0x43, 0x44, 0x45, 0x46, 0x47, 0x48,  // begin of the first
      0x51, 0x52, 0x53, 0x54, 0x55, 0x56, 0x57, 0x58,  // end of the last
      0,    33,   4,    4,    0,    2,    7,    8,     // a tile: number, encoding, age, bytes
      0,    65,   5,    0,    0,    1,    9,
  });
}

TEST(ClassTiles, AreWrittenAsTheSpecificationSays) {
  TilesWriter writer;
  writer.begin_classes({.frame_number = 9, .run_number = 3}, kWindow);
  writer.begin_message(5);
  ASSERT_TRUE(writer.append(33, Encoding::kRunStarts, 4, bytes_of({7, 8})));
  ASSERT_TRUE(writer.append(65, Encoding::kRunStartsSince, 0, bytes_of({9})));
  const auto message = writer.finish(66, 0x01020304);
  const auto body = message.subspan(kBodyOffset);
  EXPECT_EQ(Bytes(body.begin(), body.end()), some_body());
}

TEST(ClassTiles, AreReadAsTheSpecificationSays) {
  const Bytes body = some_body();
  TilesHeader header;
  TileRecords records;
  ASSERT_EQ(read_tiles(body, header, records), ReadStatus::kOk);
  EXPECT_EQ(header.geometry, geometry_of_classes());
  EXPECT_EQ(header.geometry.cell_mm, 100);
  ASSERT_TRUE(header.window.has_value());
  EXPECT_EQ(*header.window, kWindow);
  TileRecord record;
  ASSERT_TRUE(records.next(record));
  EXPECT_EQ(record.tile, 33);
  EXPECT_EQ(record.age_frames, 4);
  EXPECT_TRUE(std::ranges::equal(record.payload, bytes_of({7, 8})));
  ASSERT_TRUE(records.next(record));
  EXPECT_EQ(record.encoding, Encoding::kRunStartsSince);
  EXPECT_EQ(record.age_frames, 0);
  EXPECT_FALSE(records.next(record));
}

TEST(ClassTiles, SayTheSizeOfTheirCells) {
  TilesWriter writer;
  writer.begin_classes({}, kWindow, 500);
  TilesHeader header;
  TileRecords records;
  ASSERT_EQ(read_tiles(writer.finish(1024, 1).subspan(kBodyOffset), header, records),
            ReadStatus::kOk);
  EXPECT_EQ(header.geometry.cell_mm, 500);
  EXPECT_EQ(header.geometry.width, 1024);
}

TEST(ClassTiles, EveryMessageOfAFrameHasTheWindow) {
  TilesWriter writer;
  writer.begin_classes({}, kWindow);
  for (std::size_t tile = 0; tile < 3; ++tile) {
    ASSERT_TRUE(writer.append(tile, Encoding::kRaw, 1, Bytes(1024)));
    ASSERT_FALSE(writer.append(tile + 1, Encoding::kRaw, 1, Bytes(1024)));
    const auto message = writer.finish(tile + 1, 0);
    ASSERT_LE(message.size(), protection::kMaxMessageBytes);
    TilesHeader header;
    TileRecords records;
    ASSERT_EQ(read_tiles(message.subspan(kBodyOffset), header, records), ReadStatus::kOk);
    EXPECT_EQ(header.window, kWindow);
    EXPECT_EQ(header.first_tile, tile);
  }
}

// A grid of indexes after one of classes has neither window nor ages.
TEST(ClassTiles, LeaveTilesOfIndexesAsTheyAre) {
  TilesWriter fresh;
  fresh.begin_grid({}, geometry_of_level(0));
  ASSERT_TRUE(fresh.append(7, Encoding::kRunStarts, bytes_of({1, 2, 3})));
  const auto expected = fresh.finish(8, 0);
  TilesWriter writer;
  writer.begin_classes({}, kWindow);
  ASSERT_TRUE(writer.append(1, Encoding::kRaw, 1, Bytes(1024)));
  static_cast<void>(writer.finish(2, 0));
  writer.begin_grid({}, geometry_of_level(0));
  ASSERT_TRUE(writer.append(7, Encoding::kRunStarts, bytes_of({1, 2, 3})));
  EXPECT_TRUE(std::ranges::equal(writer.finish(8, 0), expected));
}

// docs/spec.md, 3.9: its corner is the tile of lowest x and y, and tiles begin at multiples of
// their side.
TEST(ClassWindow, ItsTilesBeginAtItsCorner) {
  const window::Area area = area_of({.corner_a = -7, .corner_b = 12});
  EXPECT_EQ(area.corner().a, -7);
  EXPECT_EQ(area.corner().b, 12);
}

constexpr std::size_t kWindowEnd = kTilesHeaderBytes + kClassWindowBytes;

TEST(ClassTiles, ALongerWindowOfALaterDayIsSkipped) {
  Bytes body = some_body();
  body.at(kTilesHeaderBytes + 1) = std::byte{kClassWindowBytes + 3};
  body.insert(body.begin() + kWindowEnd, 3, std::byte{0xAA});
  TilesHeader header;
  TileRecords records;
  ASSERT_EQ(read_tiles(body, header, records), ReadStatus::kOk);
  EXPECT_EQ(header.window, kWindow);
  TileRecord record;
  ASSERT_TRUE(records.next(record));
  EXPECT_EQ(record.tile, 33);
}

TEST(ClassTiles, AShorterWindowIsRefused) {
  Bytes body = some_body();
  TilesHeader header;
  TileRecords records;
  for (std::size_t size = 0; size < kWindowEnd; ++size) {
    EXPECT_EQ(read_tiles(std::span(body).first(size), header, records), ReadStatus::kTooShort);
  }
  for (std::size_t size = kWindowEnd; size < body.size(); ++size) {
    EXPECT_EQ(read_tiles(std::span(body).first(size), header, records), ReadStatus::kInconsistent);
  }
  body.at(kTilesHeaderBytes + 1) = std::byte{kClassWindowBytes - 1};
  EXPECT_EQ(read_tiles(body, header, records), ReadStatus::kTooShort);
  body.at(kTilesHeaderBytes) = std::byte{0xFF};  // longer than the message
  EXPECT_EQ(read_tiles(body, header, records), ReadStatus::kTooShort);
}

TEST(ClassTiles, ReadingIsTotalOnGarbage) {
  tests::Random random(63);
  for (int i = 0; i < tests::effort(200'000, 3'000); ++i) {
    Bytes body = some_body();
    for (int changes = random.between(1, 4); changes > 0; --changes) {
      body.at(random.below(body.size())) = static_cast<std::byte>(random.next());
    }
    TilesHeader header;
    TileRecords records;
    if (read_tiles(body, header, records) == ReadStatus::kOk) {
      std::uint32_t count = 0;
      for (TileRecord record; records.next(record); ++count) {
        ASSERT_LT(record.tile, header.geometry.tile_count());
      }
      ASSERT_EQ(count, header.tile_count);
      ASSERT_EQ(header.window.has_value(), header.geometry.storage == Storage::kClass);
    }
  }
}

// A street as the decision would leave it: 9 classes, each with 8 grades.
Tile street(tests::Random& random) {
  Tile cells{};
  for (int patches = random.between(0, 12); patches > 0; --patches) {
    const int known = random.between(1, kClassCount - 1) * kSurenessCount;
    const auto cell = static_cast<std::byte>(known + random.between(0, kSurenessCount - 1));
    const std::size_t first = random.below(cells.size());
    std::fill_n(cells.begin() + static_cast<std::ptrdiff_t>(first),
                std::min(random.below(400), cells.size() - first), cell);
  }
  return cells;
}

// The encoder of bytes carries classes as it carries indexes.
TEST(ClassTiles, ComeBackFromTheirCode) {
  tests::Random random(64);
  static tile_coding::Encoder encoder;
  for (int i = 0; i < tests::effort(400, 40); ++i) {
    const Tile before = street(random);
    Tile cells = before;
    cells.at(random.below(cells.size())) = std::byte{33};
    const tile_coding::Reference kept{.cells = before, .frame_number = 7};
    for (const auto& reference : {std::optional<tile_coding::Reference>(), std::optional(kept)}) {
      Tile payload{};
      const auto encoded = encoder.encode(cells, 9, reference, payload);
      Tile decoded{};
      ASSERT_EQ(tile_coding::decode(encoded.encoding, std::span(payload).first(encoded.bytes), 9,
                                    reference, decoded),
                tile_coding::DecodeStatus::kOk);
      ASSERT_EQ(decoded, cells);
      ASSERT_TRUE(are_class_bytes(decoded));
    }
  }
}

// docs/spec.md 3.9: without a pose both deviations are 65535.
TEST(ClassWindow, HasAPlaceIfSomethingWasPlacedAndThePoseIsKnown) {
  EXPECT_TRUE(kWindow.has_place());
  ClassWindow window = kWindow;
  window.sigma = {0xFFFF, 0x3132};
  EXPECT_TRUE(window.has_place());
  window.pose = {};
  EXPECT_TRUE(window.has_place()) << "the origin is a place";
  window.sigma = {0xFFFF, 0xFFFF};
  EXPECT_FALSE(window.has_place());
  window = kWindow;
  window.slices = 0;
  EXPECT_FALSE(window.has_place());
}

// docs/spec.md 3.9: 0, or class times 8 and sureness, of the classes 1 to 8.
TEST(ClassBytes, AreUnknownOrAClassWithItsSureness) {
  int valid = 0;
  for (int value = 0; value < 256; ++value) {
    const auto cell = static_cast<std::byte>(value);
    const bool is_one = value == 0 || (value >= 8 && value <= 71);
    EXPECT_EQ(is_class_byte(cell), is_one) << value;
    valid += is_one ? 1 : 0;
    Tile cells{};
    cells.back() = cell;
    EXPECT_EQ(are_class_bytes(cells), is_one) << value;
  }
  EXPECT_EQ(valid, 1 + 8 * 8);
  EXPECT_EQ(class_of(std::byte{47}), 5);
  EXPECT_EQ(sureness_of(std::byte{47}), 7);
  EXPECT_EQ(class_of(std::byte{0}), 0);
}

}  // namespace
}  // namespace iog::stream
