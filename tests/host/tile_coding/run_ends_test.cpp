// Where runs against a reference end, by the rule of tile_coding/runs.hpp taken at its word.
#include "tile_coding/run_ends.hpp"

#include <array>
#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {
namespace {

using Rows = std::array<std::uint32_t, kTileSide>;

bool is_set(const Rows& rows, std::size_t cell) {
  return ((rows.at(cell / kTileSide) >> (cell % kTileSide)) & 1U) != 0;
}

void set(Rows& rows, std::size_t cell) { rows.at(cell / kTileSide) |= 1U << (cell % kTileSide); }

std::size_t next(const Rows& rows, std::size_t cell) {
  while (cell < kTileBytes && !is_set(rows, cell)) {
    ++cell;
  }
  return cell;
}

struct Ends {
  Rows of_values{};
  Rows of_reference{};
  bool last_is_value = false;

  friend bool operator==(const Ends&, const Ends&) = default;
};

// From the first cell on: the longer of the run that is as in the reference and the run of one
// value, the former if both are as long.
Ends greedy(const Rows& changes, const Rows& differences) {
  Ends ends;
  for (std::size_t begin = 0; begin < kTileBytes;) {
    const std::size_t change = next(changes, begin + 1);
    const std::size_t difference = next(differences, begin);
    ends.last_is_value = change > difference;
    begin = ends.last_is_value ? change : difference;
    if (begin < kTileBytes) {
      set(ends.last_is_value ? ends.of_values : ends.of_reference, begin);
    }
  }
  return ends;
}

Ends by_rows(const Rows& changes, const Rows& differences) {
  Ends ends;
  RunEnds run_ends;
  for (std::size_t y = 0; y < kTileSide; ++y) {
    const RunEnds::Row row = run_ends.next(changes.at(y), differences.at(y));
    ends.of_values.at(y) = row.of_values;
    ends.of_reference.at(y) = row.of_reference;
  }
  ends.last_is_value = run_ends.last_is_value();
  return ends;
}

// One cell in `one_in`, none, or all.
Rows random_rows(tests::Random& random, int one_in) {
  Rows rows{};
  for (std::size_t cell = 0; cell < kTileBytes; ++cell) {
    if (one_in > 0 && random.one_in(one_in)) {
      set(rows, cell);
    }
  }
  return rows;
}

// The first cell has none before it that it could differ from.
TEST(RunEnds, AreThoseOfTheGreedyRule) {
  tests::Random random(97);
  for (const int changed : {0, 1, 2, 5, 40, 400}) {
    for (const int different : {0, 1, 2, 5, 40, 400}) {
      for (int i = 0; i < tests::effort(100, 5); ++i) {
        Rows changes = random_rows(random, changed);
        changes.front() &= ~1U;
        const Rows differences = random_rows(random, different);
        ASSERT_EQ(by_rows(changes, differences), greedy(changes, differences))
            << changed << ' ' << different;
      }
    }
  }
}

// Every way in which two stretches of a few cells, the second over the border of two rows, can
// differ from their reference.
TEST(RunEnds, AreThoseOfTheGreedyRuleInEveryCornerOfTwoRows) {
  constexpr unsigned kBits = 6;
  for (std::uint32_t change = 0; change < 1U << kBits; ++change) {
    for (std::uint32_t difference = 0; difference < 1U << kBits; ++difference) {
      const auto rows = [](std::uint32_t bits) {
        Rows both{};
        both[3] = bits << (32 - kBits / 2);
        both[4] = bits >> (kBits / 2);
        return both;
      };
      ASSERT_EQ(by_rows(rows(change), rows(difference)), greedy(rows(change), rows(difference)));
    }
  }
}

// By hand: marks are bits 1 and 6, bits 2, 3 and 7 are open behind them, bit 4 is not.
TEST(Flood, RunsFromMarksThroughOpenCellsIntoTheNextRow) {
  Flood flood(false);
  flood.advance(0b0100'0010, 0xFFFF'FF8C);
  EXPECT_EQ(flood.flooded(), 0xFFFF'FFCEU);
  EXPECT_EQ(flood.behind(), 0xFFFF'FF9CU);
  EXPECT_TRUE(flood.last_is_flooded());
  flood.advance(0, 0b1011);
  EXPECT_EQ(flood.flooded(), 0b0011U);
  EXPECT_EQ(flood.behind(), 0b0111U);
  EXPECT_FALSE(flood.last_is_flooded());
}

}  // namespace
}  // namespace iog::tile_coding
