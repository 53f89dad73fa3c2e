#include "window/slice_cells.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "window/eight_bytes.hpp"

namespace iog::window {
namespace {

constexpr std::size_t kSide = geometry::kTileSide;
constexpr std::size_t kBlock = SliceCells::kBlockSide;
static_assert(kBlock == EightBytes::kCount);

constexpr std::size_t kSquare = 4;

// What four rows have in each column: the bits that an index has, and those that its negative has,
// of which the sign says that a cell is hit.
struct alignas(8) SquareBits {
  std::array<std::int8_t, kSide> bits;
  std::array<std::int8_t, kSide> negative;
};

// By eight bits, the byte kBeside where one is set.
using BesideByBits = std::array<std::array<std::int8_t, EightBytes::kCount>, 256>;

consteval BesideByBits make_beside_by_bits() {
  BesideByBits table{};
  for (unsigned bits = 0; bits < table.size(); ++bits) {
    for (unsigned i = 0; i < EightBytes::kCount; ++i) {
      table[bits][i] = (bits >> i & 1U) != 0 ? std::int8_t{kBeside} : std::int8_t{0};
    }
  }
  return table;
}
constexpr BesideByBits kBesideByBits = make_beside_by_bits();

template <std::size_t... kRows>
SquareBits squares_of(const std::int8_t* rows, std::index_sequence<kRows...> /*all*/) {
  SquareBits squares;
  for (std::size_t x = 0; x < kSide; ++x) {
    squares.bits[x] = static_cast<std::int8_t>((rows[kRows * kSide + x] | ...));
    squares.negative[x] = static_cast<std::int8_t>((-rows[kRows * kSide + x] | ...));
  }
  return squares;
}

// A bit for each square in which a bit is set.
std::uint8_t known_of(const SquareBits& squares) {
  unsigned known = 0;
  for (std::size_t x = 0; x < kSide; x += kSquare) {
    std::uint32_t four = 0;
    __builtin_memcpy(&four, &squares.bits[x], sizeof four);
    known |= (four != 0 ? 1U : 0U) << x / kSquare;
  }
  return static_cast<std::uint8_t>(known);
}

bool is_hit(const SquareBits& squares) {
  return EightBytes::load(squares.negative.data())
      .bit_or(EightBytes::load(&squares.negative[8]))
      .bit_or(EightBytes::load(&squares.negative[16]))
      .bit_or(EightBytes::load(&squares.negative[24]))
      .has_negative();
}

// The bytes of a row's indexes. A bit beside an index of either sign is bit 5 of its byte, turned
// round: that of 1 ... 31 is 0, that of -1 ... -31 is 1.
void write_row(const std::int8_t* indexes, std::uint32_t bits, std::int8_t* row) {
  constexpr std::int8_t kMost = kMostIndex;
  for (std::size_t x = 0; x < kSide; ++x) {
    row[x] = std::clamp<std::int8_t>(indexes[x], -kMost, kMost);
  }
  for (std::int8_t* eight = row; bits != 0; eight += kBlock, bits >>= kBlock) {
    EightBytes::load(eight)
        .bit_xor(EightBytes::load(kBesideByBits[bits % 256].data()))
        .store(eight);
  }
}

}  // namespace

void SliceCells::copy(std::size_t tile, TileIndexes indexes, const Plane& low_and_tall) {
  unsigned hit_bands = 0;
  TileSquares known{};
  const std::int8_t* in = indexes.data();
  std::int8_t* row = tiles_[places_[tile]].data();
  for (std::size_t square_y = 0; square_y < kSquaresOfTile; ++square_y) {
    const SquareBits squares = squares_of(in, std::make_index_sequence<kSquare>());
    known[square_y] = known_of(squares);
    hit_bands |= (is_hit(squares) ? 1U : 0U) << square_y * kSquare / kBlock;
    for (std::size_t y = square_y * kSquare; y < (square_y + 1) * kSquare; ++y) {
      write_row(in, low_and_tall[y], row);
      in += kSide;
      row += kSide;
    }
  }
  known_squares_[tile] = known;
  hit_bands_[tile] = static_cast<std::uint8_t>(hit_bands);
  is_known_[tile] = true;
}

void SliceCells::note(std::size_t tile) {
  note_extent(tile);
  if (hit_bands_[tile] != 0) {
    hit_tiles_[hit_tile_count_++] = static_cast<std::uint16_t>(tile);
  }
  note_known(tile);
}

void SliceCells::note_known(std::size_t tile) {
  std::size_t at = (kRowsAround + tile / geometry::kTilesPerSide * kSquaresOfTile) * kSquareStride +
                   1 + tile % geometry::kTilesPerSide;
  for (const std::uint8_t row : known_squares_[tile]) {
    squares_[at] = row;
    at += kSquareStride;
  }
}

void SliceCells::note_extent(std::size_t tile) {
  const auto x = static_cast<std::int32_t>(tile % geometry::kTilesPerSide);
  const auto y = static_cast<std::int32_t>(tile / geometry::kTilesPerSide);
  extent_ = {{std::min(extent_.low.x, x), std::min(extent_.low.y, y)},
             {std::max(extent_.high.x, x), std::max(extent_.high.y, y)}};
}

void SliceCells::clear() {
  is_known_.fill(false);
  used_ = 0;
  forget_notes();
}

// Each tile has a place of its own, whichever core copies it.
void SliceCells::begin() {
  std::iota(places_.begin(), places_.end(), std::uint16_t{0});
  forget_notes();
}

void SliceCells::forget_notes() {
  squares_.fill(0);
  extent_ = {};
  hit_tile_count_ = 0;
}

void SliceCells::note_all() {
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (is_known_[tile]) {
      note(tile);
    }
  }
}

}  // namespace iog::window
