// The message of tiles, byte by byte as docs/spec.md 3.3 lists it, and what a receiver must
// survive.
#include "stream/tiles.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/bytes_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::stream {
namespace {

using tests::bytes_of;
using Bytes = std::vector<std::byte>;

constexpr std::size_t kBodyOffset = protection::kProtectionBytes + kHeaderBytes;

Bytes body_of(std::span<const std::byte> message) {
  const auto body = message.subspan(kBodyOffset);
  return {body.begin(), body.end()};
}

// Speaks of tiles 5 to 66 and carries 33 and 65: one of two bytes, one of one.
Bytes some_body() {
  return bytes_of({0,   5,    0,    66,   0,    2,    5,    0,    4,    0,    4,    0, 0,
                   100, 0x30, 0x39, 0xFF, 0xFF, 0x38, 0x00, 0xFF, 0xFF, 0x38, 0x00, 0, 33,
                   4,   0,    2,    7,    8,    0,    65,   5,    0,    1,    9});
}

TEST(TilesWriter, WritesWhatTheSpecificationSays) {
  TilesWriter writer;
  writer.begin_grid({.frame_number = 9, .epsilon_e5 = 0x3039}, geometry_of_level(0));
  writer.begin_message(5);
  ASSERT_TRUE(writer.append(33, Encoding::kRunStarts, bytes_of({7, 8})));
  ASSERT_TRUE(writer.append(65, Encoding::kRunStartsSince, bytes_of({9})));
  const auto message = writer.finish(66, 0x01020304);
  EXPECT_EQ(body_of(message), some_body());

  Header header;
  std::span<const std::byte> body;
  ASSERT_EQ(read_header(message.subspan(protection::kProtectionBytes), header, body),
            ReadStatus::kOk);
  EXPECT_EQ(header.type, MessageType::kTiles);
  EXPECT_EQ(header.sequence, 0x01020304U);
  EXPECT_EQ(header.frame_number, 9U);
}

TEST(TilesWriter, TheNextMessageBeginsWhereTheLastOneEnds) {
  TilesWriter writer;
  writer.begin_grid({}, geometry_of_level(0));
  ASSERT_TRUE(writer.append(1, Encoding::kRaw, Bytes(1024)));
  EXPECT_FALSE(writer.append(2, Encoding::kRaw, Bytes(1024)));
  EXPECT_EQ(writer.tile_count(), 1);
  static_cast<void>(writer.finish(2, 0));
  EXPECT_EQ(writer.tile_count(), 0);
  ASSERT_TRUE(writer.append(2, Encoding::kRaw, Bytes(1024)));
  const Bytes body = body_of(writer.finish(1024, 1));
  TilesHeader header;
  TileRecords records;
  ASSERT_EQ(read_tiles(body, header, records), ReadStatus::kOk);
  EXPECT_EQ(header.first_tile, 2);
  EXPECT_EQ(header.end_tile, 1024);
}

// Cells that are put into their place make the same messages as cells that are copied, and a tile
// that turns out to be unknown leaves its place to the next one.
TEST(TilesWriter, RawCellsMayBeInTheirPlaceAlready) {
  tests::Random random(22);
  TilesWriter copying;
  TilesWriter in_place;
  copying.begin_grid({.frame_number = 5}, geometry_of_level(0));
  in_place.begin_grid({.frame_number = 5}, geometry_of_level(0));
  int messages = 0;
  for (std::size_t tile = 0; tile < 40; ++tile) {
    Bytes cells(tile_coding::kTileBytes);
    std::ranges::generate(cells, [&] { return static_cast<std::byte>(random.next()); });
    const auto place = in_place.raw_place();
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(place.data()) % 32, 0U);
    std::ranges::copy(cells, place.begin());
    if (tile % 3 == 1) {
      continue;
    }
    if (!copying.append(tile, Encoding::kRaw, cells)) {
      ASSERT_FALSE(in_place.append(tile, Encoding::kRaw, place));
      const auto expected = copying.finish(tile, 0);
      ASSERT_TRUE(std::ranges::equal(in_place.finish(tile, 0), expected));
      ASSERT_EQ(in_place.raw_place().data(), place.data());
      ASSERT_TRUE(copying.append(tile, Encoding::kRaw, cells));
      ++messages;
    }
    ASSERT_TRUE(in_place.append(tile, Encoding::kRaw, place));
  }
  EXPECT_TRUE(std::ranges::equal(in_place.finish(40, 0), copying.finish(40, 0)));
  EXPECT_EQ(messages, 26);  // before the last one, with one tile each
}

// No message is longer than a datagram may be, and none has room for the tile that opens the next.
TEST(TilesWriter, FillsMessagesAsFarAsTheyGo) {
  tests::Random random(21);
  TilesWriter writer;
  writer.begin_grid({}, geometry_of_level(0));
  std::size_t last_bytes = 0;
  for (std::size_t tile = 0; tile < 1024; ++tile) {
    const Bytes payload(static_cast<std::size_t>(random.between(1, 1024)));
    if (writer.append(tile, Encoding::kRunStarts, payload)) {
      continue;
    }
    last_bytes = writer.finish(tile, 0).size();
    ASSERT_LE(last_bytes, protection::kMaxMessageBytes);
    ASSERT_GT(last_bytes + kTileRecordBytes + payload.size(), protection::kMaxMessageBytes);
    ASSERT_TRUE(writer.append(tile, Encoding::kRunStarts, payload));
  }
}

TEST(TilesReader, ReadsWhatTheSpecificationSays) {
  const Bytes body = some_body();
  TilesHeader header;
  TileRecords records;
  ASSERT_EQ(read_tiles(body, header, records), ReadStatus::kOk);
  EXPECT_EQ(header.first_tile, 5);
  EXPECT_EQ(header.end_tile, 66);
  EXPECT_EQ(header.geometry, geometry_of_level(0));
  EXPECT_EQ(header.epsilon_e5, 0x3039);
  TileRecord record;
  ASSERT_TRUE(records.next(record));
  EXPECT_EQ(record.tile, 33);
  EXPECT_EQ(record.encoding, Encoding::kRunStarts);
  EXPECT_TRUE(std::ranges::equal(record.payload, bytes_of({7, 8})));
  ASSERT_TRUE(records.next(record));
  EXPECT_EQ(record.tile, 65);
  EXPECT_EQ(record.encoding, Encoding::kRunStartsSince);
  EXPECT_TRUE(std::ranges::equal(record.payload, bytes_of({9})));
  EXPECT_FALSE(records.next(record));
}

TEST(TilesReader, RefusesWhatContradictsItself) {
  const auto status_with = [](std::size_t at, int value) {
    Bytes body = some_body();
    body.at(at) = static_cast<std::byte>(value);
    TilesHeader header;
    TileRecords records;
    return read_tiles(body, header, records);
  };
  EXPECT_EQ(status_with(1, 33), ReadStatus::kOk);
  EXPECT_EQ(status_with(1, 34), ReadStatus::kInconsistent);   // the first tile it carries is before
  EXPECT_EQ(status_with(1, 67), ReadStatus::kInconsistent);   // begins behind its end
  EXPECT_EQ(status_with(3, 65), ReadStatus::kInconsistent);   // the last tile it carries is behind
  EXPECT_EQ(status_with(2, 4), ReadStatus::kInconsistent);    // ends behind the grid
  EXPECT_EQ(status_with(5, 1), ReadStatus::kInconsistent);    // carries more than it says
  EXPECT_EQ(status_with(5, 3), ReadStatus::kInconsistent);    // or less
  EXPECT_EQ(status_with(6, 6), ReadStatus::kInconsistent);    // tiles of 64 cells a side
  EXPECT_EQ(status_with(6, 0), ReadStatus::kInconsistent);    // two bytes for a cell
  EXPECT_EQ(status_with(9, 1), ReadStatus::kInconsistent);    // a grid of 1025 cells
  EXPECT_EQ(status_with(32, 33), ReadStatus::kInconsistent);  // twice the same
  EXPECT_EQ(status_with(35, 2), ReadStatus::kInconsistent);   // longer than the message
  EXPECT_EQ(status_with(28, 3), ReadStatus::kInconsistent);   // longer, into the next one
  const Bytes body = some_body();
  TilesHeader header;
  TileRecords records;
  for (std::size_t size = 0; size < kTilesHeaderBytes; ++size) {
    EXPECT_EQ(read_tiles(std::span(body).first(size), header, records), ReadStatus::kTooShort);
  }
  for (std::size_t size = kTilesHeaderBytes; size < body.size(); ++size) {
    EXPECT_EQ(read_tiles(std::span(body).first(size), header, records), ReadStatus::kInconsistent);
  }
}

TEST(TilesReader, IsTotalOnGarbage) {
  tests::Random random(62);
  for (int i = 0; i < tests::effort(200'000, 3'000); ++i) {
    Bytes body = some_body();
    for (int changes = random.between(1, 4); changes > 0; --changes) {
      const auto at =
          static_cast<std::size_t>(random.between(0, static_cast<int>(body.size()) - 1));
      body.at(at) = static_cast<std::byte>(random.next());
    }
    TilesHeader header;
    TileRecords records;
    if (read_tiles(body, header, records) == ReadStatus::kOk) {
      std::uint32_t count = 0;
      for (TileRecord record; records.next(record); ++count) {
        ASSERT_LT(record.tile, header.geometry.tile_count());
        ASSERT_LE(record.payload.size(), tile_coding::kTileBytes);
      }
      ASSERT_EQ(count, header.tile_count);
    }
  }
}

// Coarse grids cover the same square.
TEST(Geometry, OfEveryLevelIsTheSameSquare) {
  for (unsigned level = 0; level <= 5; ++level) {
    const Geometry geometry = geometry_of_level(level);
    EXPECT_EQ(geometry.width * geometry.cell_mm, geometry::kCellsPerSide * geometry::kCellMm);
    EXPECT_EQ(geometry.tile_count() << (2 * level), geometry_of_level(0).tile_count());
  }
}

// A receiver takes what a car can have, and no more than the memory holds.
TEST(Geometry, IsOfAGridThatACarCanHave) {
  constexpr geometry::Grid kGrid{
      .cell_mm = 50, .columns = 1024, .rows = 640, .origin_column = 0, .origin_row = 320};
  constexpr Geometry kGeometry = geometry_of(kGrid);
  EXPECT_EQ(kGeometry.width, 1024);
  EXPECT_EQ(kGeometry.height, 640);
  EXPECT_EQ(kGeometry.cell_mm, 50);
  EXPECT_EQ(kGeometry.origin_x_mm, 0);
  EXPECT_EQ(kGeometry.origin_y_mm, -16'000);
  EXPECT_EQ(grid_of(kGeometry), kGrid);
  EXPECT_EQ(grid_of(geometry_of_level(0)), geometry::Grid{});
  const auto is_taken = [&](auto&& change) {
    Geometry geometry = kGeometry;
    change(geometry);
    return grid_of(geometry).has_value();
  };
  EXPECT_TRUE(is_taken([](Geometry& its) { its.width = 1632; }));
  EXPECT_FALSE(is_taken([](Geometry& its) { its.width = 1664; }));  // more cells than the memory
  EXPECT_FALSE(is_taken([](Geometry& its) { its.width = 8192; }));
  EXPECT_FALSE(is_taken([](Geometry& its) { its.height = 0; }));
  for (const std::uint16_t mm : std::array<std::uint16_t, 4>{0, 99, 2'000, 65'535}) {
    EXPECT_FALSE(is_taken([mm](Geometry& its) { its.cell_mm = mm; })) << mm;
  }
  EXPECT_FALSE(is_taken([](Geometry& its) { its.origin_x_mm = INT32_MIN; }));
  EXPECT_FALSE(is_taken([](Geometry& its) { its.origin_y_mm = INT32_MIN; }));
  EXPECT_FALSE(is_taken([](Geometry& its) { its.origin_x_mm = 50; }));
  EXPECT_FALSE(is_taken([](Geometry& its) { its.origin_y_mm = -16'001; }));
  EXPECT_FALSE(is_taken([](Geometry& its) { its.storage = Storage::kHighestIndex; }));
}

}  // namespace
}  // namespace iog::stream
