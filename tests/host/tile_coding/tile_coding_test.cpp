// The codes of small tiles by hand, and that every tile comes back.
#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "fakes/bytes_of.hpp"
#include "fakes/effort.hpp"
#include "tile_coding/encode.hpp"
#include "tile_coding/symbol_packing.hpp"
#include "tiles.hpp"
#include "tools/frames/tile_decoding.hpp"

namespace iog::tile_coding {
namespace {

using tests::Bytes;
using tests::bytes_of;
using tests::joined;

constexpr std::uint32_t kFrame = 1'000;

struct Coded {
  Coded(Encoding by, Bytes bytes) : encoding(by), payload(std::move(bytes)) {}

  Encoding encoding;
  Bytes payload;
  friend bool operator==(const Coded&, const Coded&) = default;
};

Coded coded(const Tile& tile, const std::optional<Reference>& reference = std::nullopt) {
  static Encoder encoder;
  Tile payload{};
  const EncodedTile result = encoder.encode(tile, kFrame, reference, payload);
  return {result.encoding,
          Bytes(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(result.bytes))};
}

// Sixteen bytes of bits, the first of them given.
Bytes sets(std::initializer_list<int> first) {
  Bytes bytes = bytes_of(first);
  bytes.resize(16);
  return bytes;
}

TEST(RunStarts, ATileThatIsNotKnownHasNoValue) {
  EXPECT_EQ(coded(flat_tile(0)), Coded(Encoding::kRunStarts, bytes_of({0})));
}

// One run, from cell 0 on: bit 0 of block 0. Of one value there are no symbols.
TEST(RunStarts, AFlatTileIsOneRun) {
  EXPECT_EQ(coded(flat_tile(-14)),
            Coded(Encoding::kRunStarts, joined({bytes_of({1, -14}), sets({1}), bytes_of({1})})));
}

// Runs of 7 at x = 0, of 9 at x = 3, of 0 at x = 4: bits 0 and 3 of block 0, bit 0 of block 1.
// Symbols 1, 2, 0; each less one if it is above the one before, and the first comes after a 0:
// digits 0, 1, 0 and a 0 that fills up the four, to base 2.
TEST(RunStarts, SymbolsLeaveOutTheOneBefore) {
  const Tile tile =
      tile_of({"7779............................", "................................"});
  EXPECT_EQ(coded(tile), Coded(Encoding::kRunStarts,
                               joined({bytes_of({2, 7, 9}), sets({0b11}),
                                       bytes_of({0b1001, 0b0001}), bytes_of({0b0100'0000})})));
}

// Row 1 is the upper half of blocks 0 and 1, row 2 the lower half of block 13, and row 3 the upper
// half of block 8. A run goes on into the next row.
TEST(RunStarts, ABlockIsFourCellsOfTwoRows) {
  const Tile tile = tile_of({"................................", "..55............................",
                             ".......................555555555", "55..............................",
                             "................................"});
  EXPECT_EQ(coded(tile),
            Coded(Encoding::kRunStarts,
                  joined({bytes_of({1, 5}), sets({0b11, 0b0010'0001}),
                          bytes_of({0b0100'0000, 0b0001'0000, 0b0100'0000, 0b1000})})));
}

// Of nine alternatives eight symbols are a number below 9^8 < 2^26. Symbols 1 to 9 are the digits 0
// to 8, as each is above the one before.
TEST(RunStarts, SymbolsAreDigitsOfNumbers) {
  const Tile tile =
      tile_of({"123456789.......................", "................................"});
  // Ten runs: 01234567 to base 9, then 8 and the 0 of what is not known, filled up by two zeros: no
  // more than the 13 bits of four digits, 9^4 < 2^13.
  constexpr std::uint32_t kNumber = 672604;
  static_assert(((((((0 * 9 + 1) * 9 + 2) * 9 + 3) * 9 + 4) * 9 + 5) * 9 + 6) * 9 + 7 == kNumber);
  constexpr std::uint32_t kRest = 8 * 9 * 9 * 9;
  constexpr std::uint64_t kBits = (std::uint64_t{kNumber} << 13 | kRest) << 1;  // 40 bits
  EXPECT_EQ(coded(tile), Coded(Encoding::kRunStarts,
                               joined({bytes_of({9, 1, 2, 3, 4, 5, 6, 7, 8, 9}), sets({0b111}),
                                       bytes_of({0xF, 0xF, 0b0011}),
                                       bytes_of({int{kBits >> 32 & 0xFF}, int{kBits >> 24 & 0xFF},
                                                 int{kBits >> 16 & 0xFF}, int{kBits >> 8 & 0xFF},
                                                 int{kBits & 0xFF}})})));
}

TEST(RunStarts, AnUnchangedTileHasNoValue) {
  const Tile tile = checkerboard(1, 2);
  EXPECT_EQ(coded(tile, Reference{.cells = tile, .frame_number = kFrame - 7}),
            Coded(Encoding::kRunStartsSince, bytes_of({7, 0})));
}

// From the first cell that differs to the end of the stretch, then as in the reference: 6 at x = 2
// of a stretch of five, and on at x = 5.
TEST(RunStarts, ARunOfAValueStartsWhereTheTileDiffers) {
  const Tile before =
      tile_of({"6644477777777777................", "................................"});
  const Tile tile =
      tile_of({"6666677777777777................", "................................"});
  EXPECT_EQ(coded(tile, Reference{.cells = before, .frame_number = kFrame - 1}),
            Coded(Encoding::kRunStartsSince,
                  joined({bytes_of({1, 1, 6}), sets({0b11}), bytes_of({0b0100, 0b0010})})));
}

TEST(SymbolPacking, NumbersHaveAsManyFoursAsFit) {
  for (std::uint32_t n = 2; n <= kMostAlternatives; ++n) {
    const Packing packing = kPackings.at(n);
    double numbers = 1;
    for (int i = 0; i < 4 * packing.fours; ++i) {
      numbers *= n;
    }
    const double of_four = static_cast<double>(n) * n * n * n;
    EXPECT_LE(numbers, double{1U << 31}) << n;
    EXPECT_GT(numbers * of_four, double{1U << 31}) << n;
    EXPECT_LE(numbers, std::exp2(packing.bits)) << n;
    EXPECT_GT(numbers, std::exp2(packing.bits - 1)) << n;
    EXPECT_LE(of_four, std::exp2(packing.bits_of_four)) << n;
    EXPECT_GT(of_four, std::exp2(packing.bits_of_four - 1)) << n;
  }
}

// The law, for one tile.
void expect_it_comes_back(const Tile& tile, const Tile& before) {
  const Reference reference{.cells = before, .frame_number = kFrame - 5};
  for (const auto& at_hand : {std::optional<Reference>(), std::optional(reference)}) {
    const Coded result = coded(tile, at_hand);
    ASSERT_LE(result.payload.size(), kTileBytes);
    Tile decoded = flat_tile(99);
    ASSERT_EQ(decode(result.encoding, result.payload, kFrame, at_hand, decoded), DecodeStatus::kOk);
    ASSERT_EQ(decoded, tile);
  }
}

TEST(TileCoding, EveryTileComesBack) {
  tests::Random random(92);
  for (int i = 0; i < tests::effort(3'000, 100); ++i) {
    const Tile tile = random.one_in(2) ? rectangles(random) : runs(random);
    expect_it_comes_back(tile, changed(tile, random));
    expect_it_comes_back(tile, rectangles(random));
  }
}

TEST(TileCoding, HardTilesComeBackAndAreNeverLongerThanRaw) {
  tests::Random random(93);
  for (const int values : {1, 2, 3, 4, 5, 14, 15, 16, 17, 64, 214, 215, 216, 255}) {
    const Tile tile = noise(random, values);
    expect_it_comes_back(tile, noise(random, values));
    expect_it_comes_back(tile, changed(tile, random));
  }
  expect_it_comes_back(checkerboard(-127, 127), flat_tile(127));
  expect_it_comes_back(checkerboard(0, 1), checkerboard(1, 0));
  expect_it_comes_back(flat_tile(0), flat_tile(1));
}

// As many values as there are, in runs of four cells; one more is sent raw.
TEST(TileCoding, ATileHasAsManyValuesAsFourDigitsFit) {
  for (const std::size_t values : {215U, 216U}) {
    Tile tile{};
    for (std::size_t i = 0; i < tile.size(); ++i) {
      tile.at(i) = static_cast<std::byte>(i / 4 % values + 1 < 128 ? i / 4 % values + 1
                                                                   : i / 4 % values + 2);
    }
    EXPECT_EQ(coded(tile).encoding, values == 215 ? Encoding::kRunStarts : Encoding::kRaw);
    expect_it_comes_back(tile, flat_tile(1));
  }
}

// -128 is no index. Where it comes nevertheless, nothing is written beside the payload, and what is
// in it is refused or another tile; the sanitizers watch.
TEST(TileCoding, ATileWithAllBytesThereAreIsHandled) {
  Tile tile{};
  for (std::size_t i = 0; i < tile.size(); ++i) {
    tile.at(i) = static_cast<std::byte>(i / 2);
  }
  EXPECT_LE(coded(tile).payload.size(), kTileBytes);
  EXPECT_LE(coded(tile, Reference{.cells = flat_tile(1), .frame_number = 999}).payload.size(),
            kTileBytes);
  const Tile none = flat_tile(-128);
  EXPECT_LE(coded(none, Reference{.cells = flat_tile(1), .frame_number = 999}).payload.size(),
            kTileBytes);
}

}  // namespace
}  // namespace iog::tile_coding
