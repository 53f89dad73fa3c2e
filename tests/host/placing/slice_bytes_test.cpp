// The bytes of a tile are those of its cells one by one, and its notes say where something is.
#include "placing/slice_bytes.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::placing {
namespace {

constexpr std::size_t kRowCells = geometry::kTileSide;
using Cells = std::array<std::int8_t, geometry::kTileCells>;

void expect_right(const Cells& indexes) {
  Cells bytes{};
  const TileNotes notes = write_bytes(indexes.data(), bytes.data());
  for (std::size_t i = 0; i < indexes.size(); ++i) {
    ASSERT_EQ(bytes[i], byte_of(indexes[i], false)) << i;
  }
  for (std::size_t square = 0; square < kSquaresOfTile * kSquaresOfTile; ++square) {
    const std::size_t x = square % kSquaresOfTile;
    const std::size_t y = square / kSquaresOfTile;
    bool is_known = false;
    for (std::size_t i = 0; i < 16; ++i) {
      is_known = is_known || indexes[(4 * y + i / 4) * kRowCells + 4 * x + i % 4] != 0;
    }
    ASSERT_EQ((notes.known[y] >> x & 1) != 0, is_known) << x << " " << y;
  }
  for (std::size_t band = 0; band < 8; ++band) {
    bool is_hit = false;
    for (std::size_t i = 0; band < 4 && i < 8 * kRowCells; ++i) {
      is_hit = is_hit || indexes[8 * band * kRowCells + i] > 0;
    }
    ASSERT_EQ((notes.hit_bands >> band & 1) != 0, is_hit) << band;
  }
}

TEST(SliceBytes, OfNothingAreNothing) { expect_right({}); }

// Each place with the least and the greatest that an index can be, and with those beside 31.
TEST(SliceBytes, OfOneCell) {
  for (std::size_t i = 0; i < geometry::kTileCells; ++i) {
    for (const int index : {-127, -32, -31, -1, 1, 31, 32, 127}) {
      Cells indexes{};
      indexes[i] = static_cast<std::int8_t>(index);
      expect_right(indexes);
    }
  }
}

TEST(SliceBytes, OfAnyTile) {
  tests::Random random(851);
  for (int one_in = 1; one_in < 2'000; one_in *= 2) {
    Cells indexes{};
    for (std::int8_t& index : indexes) {
      index = random.one_in(one_in) ? static_cast<std::int8_t>(random.between(-127, 127))
                                    : std::int8_t{0};
    }
    expect_right(indexes);
  }
}

// Of cells of either sign, and of none where nothing is known.
TEST(SliceBytes, HaveTheBitBesideThemThatIsSet) {
  tests::Random random(852);
  for (int round = 0; round < 100; ++round) {
    Cells indexes{};
    window::Plane has_bit{};
    for (std::size_t i = 0; i < indexes.size(); ++i) {
      const int index = random.one_in(3) ? 0 : random.between(-127, 127);
      indexes[i] = static_cast<std::int8_t>(index);
      const bool is_set = index != 0 && random.one_in(1 + round % 9);
      has_bit[i / kRowCells] |= (is_set ? 1U : 0U) << i % kRowCells;
    }
    Cells bytes{};
    static_cast<void>(write_bytes(indexes.data(), bytes.data()));
    set_beside(has_bit, bytes.data());
    for (std::size_t i = 0; i < indexes.size(); ++i) {
      const bool is_set = (has_bit[i / kRowCells] >> i % kRowCells & 1U) != 0;
      ASSERT_EQ(bytes[i], byte_of(indexes[i], is_set)) << i;
    }
  }
}

}  // namespace
}  // namespace iog::placing
