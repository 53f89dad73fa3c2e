#include "window/slice_cells.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "window/bring.hpp"
#include "window/eight_bytes.hpp"
#include "work/before_images.hpp"

namespace iog::window {
namespace {

constexpr std::size_t kSide = geometry::kTileSide;
constexpr std::size_t kBlock = SliceCells::kBlockSide;
static_assert(kBlock == EightBytes::kCount);

constexpr std::array<std::int8_t, kSide> kUnknown{};

// What a band has in each column: the bits that an index has, and those that its negative has, of
// which the sign says that a cell is hit.
struct alignas(8) BandBits {
  std::array<std::int8_t, kSide> bits;
  std::array<std::int8_t, kSide> negative;
};

// A byte that is 1 for each of six bits that is set, in its place.
constexpr std::size_t kNearBits = 6;
using ByteByBit = std::array<std::array<std::int8_t, EightBytes::kCount>, 1U << kNearBits>;

consteval ByteByBit make_byte_by_bit() {
  ByteByBit table{};
  for (unsigned bits = 0; bits < table.size(); ++bits) {
    for (unsigned i = 0; i < kNearBits; ++i) {
      table[bits][i] = static_cast<std::int8_t>(bits >> i & 1U);
    }
  }
  return table;
}
constexpr ByteByBit kByteByBit = make_byte_by_bit();

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
BandBits band_of(const std::int8_t* rows, std::index_sequence<kRows...> /*all*/) {
  BandBits band;
  for (std::size_t x = 0; x < kSide; ++x) {
    band.bits[x] = static_cast<std::int8_t>((rows[kRows * kSide + x] | ...));
    band.negative[x] = static_cast<std::int8_t>((-rows[kRows * kSide + x] | ...));
  }
  return band;
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
  unsigned known_blocks = 0;
  const std::int8_t* in = indexes.data();
  std::int8_t* row = &cells_[first_of(tile)];
  for (std::size_t block_y = 0; block_y < kBlocksOfTile; ++block_y) {
    for (std::size_t y = 0; y < kBlock; ++y) {
      bring_line(&row[y * kStride]);
    }
    const BandBits band = band_of(in, std::make_index_sequence<kBlock>());
    for (std::size_t y = block_y * kBlock; y < (block_y + 1) * kBlock; ++y) {
      write_row(in, low_and_tall[y], row);
      in += kSide;
      row += kStride;
    }
    for (std::size_t block_x = 0; block_x < kBlocksOfTile; ++block_x) {
      const bool is_known = !EightBytes::load(&band.bits[block_x * kBlock]).is_zero();
      known_blocks |= (is_known ? 1U : 0U) << (block_y * kBlocksOfTile + block_x);
      const bool is_hit = EightBytes::load(&band.negative[block_x * kBlock]).has_negative();
      hit_bands |= (is_hit ? 1U : 0U) << block_y;
    }
  }
  hit_bands_[tile] = static_cast<std::uint8_t>(hit_bands);
  known_blocks_[tile] = static_cast<std::uint16_t>(known_blocks);
  is_known_[tile] = true;
}

void SliceCells::note(std::size_t tile) {
  note_extent(tile);
  if (hit_bands_[tile] != 0) {
    hit_tiles_[hit_tile_count_++] = static_cast<std::uint16_t>(tile);
  }
  note_known(tile);
}

// A block is above or to the right of nine blocks, itself included. So what is known of the tile's
// four rows of blocks counts for six rows of six: `rows` has three of the rows in its low bits.
void SliceCells::note_known(std::size_t tile) {
  constexpr unsigned kRowBits = kBlocksOfTile;
  static_assert(kBlocksBefore == 2);
  std::int8_t* near = &is_near_[tile / geometry::kTilesPerSide * kBlocksOfTile * kNearStride +
                                tile % geometry::kTilesPerSide * kBlocksOfTile];
  unsigned rows = unsigned{known_blocks_[tile]} << 2 * kRowBits;
  for (std::size_t y = 0; y < kBlocksOfTile + kBlocksBefore; ++y, rows >>= kRowBits) {
    const unsigned row = (rows | rows >> kRowBits | rows >> 2 * kRowBits) & ((1U << kRowBits) - 1);
    const unsigned wide = row | row << 1 | row << 2;
    EightBytes::load(near).bit_or(EightBytes::load(kByteByBit[wide].data())).store(near);
    near += kNearStride;
  }
}

void SliceCells::note_extent(std::size_t tile) {
  const auto x = static_cast<std::int32_t>(tile % geometry::kTilesPerSide);
  const auto y = static_cast<std::int32_t>(tile / geometry::kTilesPerSide);
  extent_ = {{std::min(extent_.low.x, x), std::min(extent_.low.y, y)},
             {std::max(extent_.high.x, x), std::max(extent_.high.y, y)}};
}

void SliceCells::clear() {
  begin();
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    leave(tile);
  }
}

void SliceCells::begin() {
  is_near_.fill(0);
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

void SliceCells::leave(std::size_t tile) {
  if (!is_known_[tile]) {
    return;
  }
  std::int8_t* row = &cells_[first_of(tile)];
  for (std::size_t y = 0; y < kSide; ++y, row += kStride) {
    __builtin_memcpy(row, kUnknown.data(), kSide);
  }
  work::keep_order();
  is_known_[tile] = false;
}

}  // namespace iog::window
