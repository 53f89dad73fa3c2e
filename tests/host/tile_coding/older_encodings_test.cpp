// What targets of interface version 3 send, by hand.
#include "tile_coding/older_encodings.hpp"

#include <gtest/gtest.h>

#include "fakes/bytes_of.hpp"
#include "tile_coding/decode.hpp"
#include "tiles.hpp"

namespace iog::tile_coding {
namespace {

using tests::Bytes;
using tests::bytes_of;

struct Code {
  const char* name;
  Encoding encoding;
  Bytes payload;
  Tile tile;
};

const Tile& before() {
  static const Tile tile = checkerboard(1, 2);
  return tile;
}

Tile before_with(std::size_t cell, int value) {
  Tile tile = before();
  tile.at(cell) = static_cast<std::byte>(value);
  return tile;
}

std::vector<Code> codes() {
  return {
      // Ten zeros, a one, ten zeros: a run of 1024 cells.
      {"flat, runs", Encoding::kRunLength, bytes_of({1, 0, 0x00, 0x20, 0x00}), flat_tile(0)},
      // Runs of 3 cells of 7, 1 of 9, 1020 of 0. The first symbol of three has two bits, the others
      // one of the two that are left: 00 011 | 0 1 | 1 000000000 1111111100; the last is symbol 2,
      // less one as the symbol before is 1.
      {"three runs", Encoding::kRunLength,
       bytes_of({3, 7, 9, 0, 0b00'011'0'1'1, 0b00000000, 0b0'1111111, 0b100'00000}),
       tile_of({"7779............................", "................................"})},
      {"flat, quadtree", Encoding::kQuadtree, bytes_of({1, -14, 0}), flat_tile(-14)},
      // The root, its first quarter and so on are split (1), four times; the first 2 x 2 block is a
      // leaf of 0 (0 0), the second is split (1) into 0 1 0 0. Leaves of 0 follow: two of 2 x 2
      // cells, and three each of 4 x 4, 8 x 8 and 16 x 16.
      {"a single cell", Encoding::kQuadtree,
       bytes_of(
           {2, 0, 5, 0b1111'00'1'0, 0b100'00'00'0, 0b0'00'00'00'0, 0b0'00'00'00'0, 0b0'00'00'000}),
       tile_of({"...5............................", "................................"})},
      {"unchanged", Encoding::kChangedSince, bytes_of({1, 2, 3, 4, 0, 0x00, 0x20, 0x00}), before()},
      // As before 2 cells, symbol 0: 0 010; a cell of 9, symbol 1: 1, of no bits as the one before
      // was the other; 1021 cells as before: 000000000 1111111101.
      {"a cell", Encoding::kChangedSince,
       bytes_of({1, 2, 3, 4, 1, 9, 0b0'010'1'000, 0b000000'11, 0b11111101}), before_with(2, 9)},
  };
}

DecodeStatus decoded(Encoding encoding, const Bytes& payload, Tile& cells) {
  return decode(encoding, payload, 0, Reference{.cells = before(), .frame_number = 0x01020304},
                cells);
}

TEST(OlderEncodings, AreReadAsTheyWereWritten) {
  for (const Code& code : codes()) {
    Tile cells = flat_tile(99);
    EXPECT_EQ(decoded(code.encoding, code.payload, cells), DecodeStatus::kOk) << code.name;
    EXPECT_EQ(cells, code.tile) << code.name;
  }
}

TEST(OlderEncodings, APayloadThatIsCutOrHasATailIsRefused) {
  for (const Code& code : codes()) {
    Tile cells{};
    for (std::size_t size = 0; size < code.payload.size(); ++size) {
      const Bytes cut(code.payload.begin(),
                      code.payload.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_EQ(decoded(code.encoding, cut, cells), DecodeStatus::kMalformed) << code.name << size;
    }
    Bytes longer = code.payload;
    longer.push_back(std::byte{0});
    ASSERT_EQ(decoded(code.encoding, longer, cells), DecodeStatus::kMalformed) << code.name;
  }
}

TEST(OlderEncodings, WhatNoEncoderWritesIsRefused) {
  Tile cells{};
  // 1025 cells: ten zeros, 10000000001.
  EXPECT_EQ(decoded(Encoding::kRunLength, bytes_of({1, 0, 0x00, 0x20, 0x08}), cells),
            DecodeStatus::kMalformed);
  EXPECT_EQ(decoded(Encoding::kRunLength, bytes_of({0, 0}), cells), DecodeStatus::kMalformed);
  EXPECT_EQ(decoded(Encoding::kQuadtree, bytes_of({0, 0}), cells), DecodeStatus::kMalformed);
  EXPECT_EQ(decoded(Encoding::kQuadtree, bytes_of({1, -128, 0}), cells), DecodeStatus::kMalformed);
}

TEST(OlderEncodings, AnotherReferenceIsSaid) {
  const Bytes payload = bytes_of({1, 2, 3, 5, 0, 0x00, 0x20, 0x00});
  Tile cells{};
  EXPECT_EQ(reference_frame(Encoding::kChangedSince, payload, 0), 0x01020305U);
  EXPECT_EQ(decoded(Encoding::kChangedSince, payload, cells), DecodeStatus::kUnknownReference);
  EXPECT_EQ(decode(Encoding::kChangedSince, payload, 0, std::nullopt, cells),
            DecodeStatus::kUnknownReference);
}

}  // namespace
}  // namespace iog::tile_coding
