// The runs of a tile against a reference, by the rule of tile_coding/tile_runs.hpp taken at its
// word: stretch by stretch, where the code goes by cells or by carries.
#include "tile_coding/tile_runs.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/effort.hpp"
#include "tiles.hpp"

namespace iog::tile_coding {
namespace {

struct Run {
  std::size_t begin;
  int value;  // of a cell as it is sent
  friend bool operator==(const Run&, const Run&) = default;
};
constexpr int kAsReference = 1000;

// All runs but one as in the reference with which the tile begins.
std::vector<Run> runs_by_the_rule(const Tile& tile, const Tile& reference) {
  std::vector<Run> runs;
  bool was_value = false;
  for (std::size_t begin = 0; begin < tile.size();) {
    std::size_t end = begin;
    std::size_t first_difference = tile.size();
    for (; end < tile.size() && tile.at(end) == tile.at(begin); ++end) {
      if (tile.at(end) != reference.at(end) && first_difference == tile.size()) {
        first_difference = end;
      }
    }
    const bool differs = first_difference < tile.size();
    if (was_value && first_difference > begin) {
      runs.push_back({begin, kAsReference});
    }
    if (differs) {
      runs.push_back({first_difference, std::to_integer<std::int8_t>(tile.at(begin))});
    }
    was_value = differs;
    begin = end;
  }
  return runs;
}

// What TileRuns says, its starts read back as docs/spec.md 3.4 tells.
std::vector<Run> runs_found(const Tile& tile, const std::optional<TileCells>& reference) {
  static TileRuns found;
  found.find(tile, reference);
  std::array<std::byte, TileRuns::kMostStartBytes> bytes{};
  const std::size_t written = found.write_starts(bytes);
  std::array<bool, kTileBytes> is_start{};
  std::size_t next = 16;
  for (std::size_t block = 0; block < 128; ++block) {
    if ((std::to_integer<unsigned>(bytes.at(block / 8)) >> block % 8 & 1U) == 0) {
      continue;
    }
    const auto cells = std::to_integer<unsigned>(bytes.at(next++));
    EXPECT_NE(cells, 0U) << "no start in block " << block;
    for (std::size_t i = 0; i < 8; ++i) {
      const std::size_t x = block % 8 * 4 + i % 4;
      const std::size_t y = block / 8 * 2 + i / 4;
      is_start.at(y * kTileSide + x) = (cells >> i & 1U) != 0;
    }
  }
  EXPECT_EQ(next, written);
  const auto values = std::as_bytes(found.fours());
  std::vector<Run> runs;
  for (std::size_t cell = 0; cell < kTileBytes; ++cell) {
    if (is_start.at(cell)) {
      const std::byte value = values[runs.size()];
      const bool is_value = value != std::byte{found.as_reference()};
      runs.push_back({cell, is_value ? std::to_integer<std::int8_t>(value) : kAsReference});
    }
  }
  EXPECT_EQ(values.size(), (runs.size() + 3) / 4 * 4);
  for (std::size_t i = runs.size(); i < values.size(); ++i) {
    EXPECT_EQ(values[i], std::byte{found.as_reference()});
  }
  return runs;
}

void expect_the_rule(const Tile& tile, const Tile& reference) {
  ASSERT_EQ(runs_found(tile, reference), runs_by_the_rule(tile, reference));
  ASSERT_EQ(runs_found(tile, std::nullopt), runs_by_the_rule(tile, Tile{}));
}

TEST(TileRuns, AreThoseOfTheRule) {
  tests::Random random(97);
  for (int i = 0; i < tests::effort(3'000, 100); ++i) {
    const Tile tile = random.one_in(4) ? noise(random, random.between(1, 5)) : runs(random);
    const Tile reference = random.one_in(3) ? runs(random) : changed(tile, random);
    expect_the_rule(tile, reference);
    expect_the_rule(rectangles(random), reference);
  }
}

// A carry goes through all of the tile, or through nothing.
TEST(TileRuns, AreThoseOfTheRuleWhereAllOrNothingDiffers) {
  for (const int value : {-127, -1, 1, 127}) {
    expect_the_rule(flat_tile(value), flat_tile(0));
    expect_the_rule(flat_tile(value), flat_tile(value));
    expect_the_rule(checkerboard(value, 0), flat_tile(0));
    expect_the_rule(checkerboard(0, value), checkerboard(value, 0));
    for (const std::size_t cell : {0U, 1U, 30U, 31U, 32U, 33U, 62U, 991U, 992U, 1022U, 1023U}) {
      Tile other = flat_tile(value);
      other.at(cell) = std::byte{3};
      expect_the_rule(other, flat_tile(value));
      expect_the_rule(flat_tile(value), other);
    }
  }
}

// Every way in which a few cells over the border of two rows, of two pairs of rows, and of four
// rows can change and differ.
TEST(TileRuns, AreThoseOfTheRuleInEveryCornerOfTwoRows) {
  constexpr unsigned kCells = 6;
  for (const std::size_t row : {1U, 2U, 4U, 8U, 31U}) {
    for (unsigned values = 0; values < 1U << kCells; ++values) {
      for (unsigned differences = 0; differences < 1U << kCells; ++differences) {
        Tile tile = flat_tile(1);
        Tile reference = flat_tile(1);
        for (unsigned i = 0; i < kCells; ++i) {
          const std::size_t cell = row * kTileSide - kCells / 2 + i;
          tile.at(cell) = std::byte{(values >> i & 1U) != 0 ? std::uint8_t{2} : std::uint8_t{0}};
          reference.at(cell) = (differences >> i & 1U) != 0 ? std::byte{9} : tile.at(cell);
        }
        ASSERT_EQ(runs_found(tile, reference), runs_by_the_rule(tile, reference));
      }
    }
  }
}

}  // namespace
}  // namespace iog::tile_coding
