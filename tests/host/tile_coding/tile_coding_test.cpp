// The codes of small tiles by hand, and that every tile comes back.
#include <algorithm>
#include <gtest/gtest.h>

#include "fakes/bytes_of.hpp"
#include "fakes/effort.hpp"
#include "tile_coding/decode.hpp"
#include "tile_coding/encode.hpp"
#include "tiles.hpp"

namespace iog::tile_coding {
namespace {

using tests::Bytes;
using tests::bytes_of;

struct Coded {
  Encoding encoding;
  Bytes payload;
};

Coded coded(const Tile& tile, Encoding encoding,
            const std::optional<Reference>& reference = std::nullopt) {
  static Encoder encoder;
  std::array<std::byte, kTileBytes> payload{};
  const EncodedTile result = encoder.encode_as(encoding, tile, reference, payload);
  return {.encoding = result.encoding,
          .payload =
              Bytes(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(result.bytes))};
}

// Rows of one character a cell; rows that are not given are like the last one.
Tile tile_of(std::initializer_list<const char*> rows) {
  Tile tile{};
  for (std::size_t y = 0; y < kTileSide; ++y) {
    const char* row = *(rows.begin() + std::min(y, rows.size() - 1));
    for (std::size_t x = 0; x < kTileSide; ++x) {
      tile.at(y * kTileSide + x) =
          row[x] == '.' ? std::byte{0} : static_cast<std::byte>(row[x] - '0');
    }
  }
  return tile;
}

// One run of 1024 cells: ten zeros, a one, ten zeros.
TEST(RunLength, AFlatTileIsOneRun) {
  EXPECT_EQ(coded(flat_tile(0), Encoding::kRunLength).payload, bytes_of({1, 0, 0x00, 0x20, 0x00}));
}

// Runs of 3 cells of 7, 1 of 9, 1020 of 0. The first symbol of three has two bits, the others one
// of the two that are left: 00 011 | 0 1 | 0 ...; the last is symbol 2, of which the one before, 1,
// is taken out: 1 000000000 1111111100.
TEST(RunLength, SymbolsLeaveOutTheOneBefore) {
  const Tile tile =
      tile_of({"7779............................", "................................"});
  EXPECT_EQ(coded(tile, Encoding::kRunLength).payload,
            bytes_of({3, 7, 9, 0, 0b00'011'0'1'1, 0b00000000, 0b0'1111111, 0b100'00000}));
}

TEST(Quadtree, AFlatTileIsOneLeaf) {
  EXPECT_EQ(coded(flat_tile(-14), Encoding::kQuadtree).payload, bytes_of({1, -14, 0}));
}

// A single cell of 5 at x = 3, y = 0. The root, its first quarter and so on are split (1), four
// times; the first 2 x 2 block is a leaf of 0 (0 0), the second is split (1) into 0 1 0 0. Then of
// each level three leaves (0 0): of 2 x 2, 4 x 4, 8 x 8 and 16 x 16 cells, but for the block that
// is done, 2 of 2 x 2 and 3 each of the others.
TEST(Quadtree, ASingleCellIsAPathOfSplitBlocks) {
  const Tile tile =
      tile_of({"...5............................", "................................"});
  EXPECT_EQ(coded(tile, Encoding::kQuadtree).payload,
            bytes_of({2, 0, 5, 0b1111'00'1'0, 0b100'00'00'0, 0b0'00'00'00'0, 0b0'00'00'00'0,
                      0b0'00'00'000}));
}

// As long as what has changed takes no more than the reference did, nothing else is tried.
TEST(ChangedSince, IsTakenAtOnceUpToTheBytesOfItsReference) {
  tests::Random random(96);
  const auto encoder = std::make_unique<Encoder>();
  const Tile before = noise(random, 3);
  Tile tile = flat_tile(5);
  tile.at(17) = std::byte{6};
  std::array<std::byte, kTileBytes> payload{};
  Reference reference{.cells = before, .frame_number = 7};
  EXPECT_NE(encoder->encode(tile, reference, payload).encoding, Encoding::kChangedSince);
  const std::size_t bytes = encoder->sizes().at(3);
  reference.bytes = bytes - 1;
  EXPECT_NE(encoder->encode(tile, reference, payload).encoding, Encoding::kChangedSince);
  reference.bytes = bytes;
  const EncodedTile encoded = encoder->encode(tile, reference, payload);
  EXPECT_EQ(encoded.encoding, Encoding::kChangedSince);
  EXPECT_EQ(encoded.bytes, bytes);
}

TEST(ChangedSince, AnUnchangedTileIsOneRun) {
  const Tile tile = checkerboard(1, 2);
  const Reference reference{.cells = tile, .frame_number = 0x01020304};
  EXPECT_EQ(coded(tile, Encoding::kChangedSince, reference).payload,
            bytes_of({1, 2, 3, 4, 0, 0x00, 0x20, 0x00}));
}

// The law, for one tile and each encoding.
void expect_all_encodings_to_return(const Tile& tile, const Tile& before) {
  const Reference reference{.cells = before, .frame_number = 7};
  static Encoder encoder;
  Tile payload{};
  const EncodedTile shortest = encoder.encode(tile, reference, payload);
  const Encoder::Sizes sizes = encoder.sizes();
  ASSERT_EQ(shortest.bytes, *std::ranges::min_element(sizes));
  ASSERT_LE(shortest.bytes, kTileBytes);
  for (std::size_t i = 0; i < kEncodingCount; ++i) {
    const auto encoding = static_cast<Encoding>(i);
    const Coded result = coded(tile, encoding, reference);
    ASSERT_EQ(result.payload.size(), std::min(sizes.at(i), kTileBytes)) << i;
    ASSERT_EQ(result.encoding, sizes.at(i) < kTileBytes ? encoding : Encoding::kRaw);
    Tile decoded = flat_tile(99);
    ASSERT_EQ(decode(result.encoding, result.payload, reference, decoded), DecodeStatus::kOk) << i;
    ASSERT_EQ(decoded, tile) << i;
  }
}

TEST(TileCoding, EveryTileComesBackFromEveryEncoding) {
  tests::Random random(92);
  for (int i = 0; i < tests::effort(2'000, 60); ++i) {
    const Tile tile = rectangles(random);
    expect_all_encodings_to_return(tile, changed(tile, random));
    expect_all_encodings_to_return(tile, rectangles(random));
  }
}

TEST(TileCoding, HardTilesComeBackAndAreNeverLongerThanRaw) {
  tests::Random random(93);
  for (const int values : {1, 2, 3, 4, 5, 16, 17, 64, 255}) {
    const Tile tile = noise(random, values);
    expect_all_encodings_to_return(tile, noise(random, values));
    expect_all_encodings_to_return(tile, changed(tile, random));
  }
  expect_all_encodings_to_return(checkerboard(-127, 127), flat_tile(127));
  expect_all_encodings_to_return(checkerboard(0, 1), checkerboard(1, 0));
  expect_all_encodings_to_return(flat_tile(0), flat_tile(1));
}

// -128 is no index. Where it comes nevertheless, nothing is written beside the payload, and what is
// in it is refused or another tile; the sanitizers watch.
TEST(TileCoding, ATileWithAllBytesThereAreIsHandled) {
  Tile tile{};
  for (std::size_t i = 0; i < tile.size(); ++i) {
    tile.at(i) = static_cast<std::byte>(i / 2);
  }
  for (std::size_t i = 0; i < kEncodingCount; ++i) {
    EXPECT_LE(coded(tile, static_cast<Encoding>(i), Reference{.cells = tile, .frame_number = 1})
                  .payload.size(),
              kTileBytes);
  }
}

// An independent count: blocks are split as long as they have two values.
struct Census {
  std::size_t nodes_with_bit = 0;
  std::size_t leaves = 0;
};

void count_blocks(const Tile& tile, std::size_t x, std::size_t y, std::size_t side,
                  Census& census) {
  bool flat = true;
  for (std::size_t i = 0; i < side * side; ++i) {
    flat = flat && tile.at((y + i / side) * kTileSide + x + i % side) == tile.at(y * kTileSide + x);
  }
  census.nodes_with_bit += side > 1 ? 1 : 0;
  if (flat) {
    ++census.leaves;
    return;
  }
  for (std::size_t child = 0; child < 4; ++child) {
    count_blocks(tile, x + child % 2 * side / 2, y + child / 2 * side / 2, side / 2, census);
  }
}

// The same on every machine, however it compares cells.
TEST(CellMap, MarksTheCellsThatDiffer) {
  tests::Random random(95);
  for (int i = 0; i < tests::effort(500, 20); ++i) {
    const Tile tile = random.one_in(2) ? noise(random, 3) : rectangles(random);
    const Tile other = random.one_in(2) ? noise(random, 3) : tile;
    CellMap changes;
    CellMap steps;
    CellMap differences;
    changes.mark_changes(tile);
    steps.mark_steps(tile);
    differences.mark_differences(tile, other);
    for (std::size_t cell = 0; cell < kTileBytes; ++cell) {
      const auto is_marked = [cell](const CellMap& map) {
        return ((map.row(cell / kTileSide) >> (cell % kTileSide)) & 1U) != 0;
      };
      ASSERT_EQ(is_marked(changes), cell > 0 && tile[cell] != tile[cell - 1]);
      ASSERT_EQ(is_marked(steps), cell >= kTileSide && tile[cell] != tile[cell - kTileSide]);
      ASSERT_EQ(is_marked(differences), tile[cell] != other[cell]);
    }
  }
}

// Counted cell by cell. Long parts, because the machine may count them apart.
TEST(CellMap, CountsThePartsAndTheLogarithmsOfTheirLengths) {
  tests::Random random(97);
  for (int i = 0; i < tests::effort(2000, 200); ++i) {
    Tile tile{};
    const int sparseness = random.between(1, 400);
    for (std::size_t cell = 1; cell < kTileBytes; ++cell) {
      tile[cell] = random.one_in(sparseness) ? ~tile[cell - 1] : tile[cell - 1];
    }
    CellMap changes;
    changes.mark_changes(tile);
    Parts expected;
    std::size_t length = 0;
    for (std::size_t cell = 0; cell < kTileBytes; ++cell) {
      ++length;
      if (cell + 1 == kTileBytes || tile[cell + 1] != tile[cell]) {
        ++expected.count;
        for (; length > 1; length /= 2) {
          ++expected.log2_sum;
        }
        length = 0;
      }
    }
    const Parts parts = changes.parts();
    ASSERT_EQ(parts.count, expected.count) << sparseness;
    ASSERT_EQ(parts.log2_sum, expected.log2_sum) << sparseness;
  }
}

TEST(Quadtree, HasNoMoreBlocksThanItMust) {
  tests::Random random(94);
  for (int i = 0; i < tests::effort(500, 20); ++i) {
    const Tile tile = random.one_in(4) ? noise(random, 2) : rectangles(random);
    CellMap changes;
    CellMap steps;
    changes.mark_changes(tile);
    steps.mark_steps(tile);
    Quadtree tree;
    tree.find(changes, steps);
    Census census;
    count_blocks(tile, 0, 0, kTileSide, census);
    ASSERT_EQ(tree.coded_bytes(8), 1 + 8 + (census.nodes_with_bit + 3 * census.leaves + 7) / 8);
  }
}

}  // namespace
}  // namespace iog::tile_coding
