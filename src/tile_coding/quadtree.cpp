#include "tile_coding/quadtree.hpp"

#include <algorithm>
#include <bit>

#include "tile_coding/bit_stream.hpp"
#include "wire/byte_order.hpp"

namespace iog::tile_coding {
namespace {

// The bits of a number of five bits, each moved to twice its place.
constexpr std::array<std::uint16_t, kTileSide> make_spread() {
  std::array<std::uint16_t, kTileSide> spread{};
  for (std::uint32_t number = 0; number < spread.size(); ++number) {
    for (std::uint32_t bit = 0; bit < kTileSideLog2; ++bit) {
      spread[number] =
          static_cast<std::uint16_t>(spread[number] | ((number >> bit) & 1U) << (2 * bit));
    }
  }
  return spread;
}
constexpr auto kSpread = make_spread();

// Cell numbers of five bits of a Morton number; those of its lower and upper half add up.
struct Halves {
  std::array<std::uint16_t, 32> lower;
  std::array<std::uint16_t, 32> upper;
};

constexpr Halves make_halves() {
  Halves halves{};
  for (std::size_t y = 0; y < kTileSide; ++y) {
    for (std::size_t x = 0; x < kTileSide; ++x) {
      const std::size_t m = kSpread[x] | static_cast<std::size_t>(kSpread[y]) << 1;
      const auto cell = static_cast<std::uint16_t>(y * kTileSide + x);
      if (m < 32) {
        halves.lower[m] = cell;
      }
      if (m % 32 == 0) {
        halves.upper[m / 32] = cell;
      }
    }
  }
  return halves;
}
constexpr Halves kHalves = make_halves();

std::uint32_t word_of(TileCells cells, std::size_t cell) {
  return wire::load_le32(cells.subspan(cell).first<4>());
}

}  // namespace

std::size_t cell_of_morton(std::size_t m) {
  return std::size_t{kHalves.lower[m % 32]} + kHalves.upper[m / 32];
}

void Quadtree::find(TileCells cells) {
  split_count_[0] = find_level_1(cells);
  for (std::size_t level = 2; level <= kLevels; ++level) {
    split_count_[level - 1] = find_level(level, cells);
  }
}

// A word of each of two rows holds two blocks, neighbours in the Morton order. Bytes 0 and 2 of a
// row against 1 and 3, then the rows against each other.
std::size_t Quadtree::find_level_1(TileCells cells) {
  BlockMap& split = split_[0];
  split.clear();
  std::size_t count = 0;
  for (std::size_t y = 0; y < kTileSide; y += 2) {
    for (std::size_t x = 0; x < kTileSide; x += 4) {
      const std::uint32_t lower = word_of(cells, y * kTileSide + x);
      const std::uint32_t upper = word_of(cells, (y + 1) * kTileSide + x);
      const std::uint32_t difference = (lower ^ upper) | ((lower ^ lower >> 8) & 0x00FF00FFU);
      if (difference != 0) {
        const std::uint32_t left = (difference & 0xFFFFU) != 0 ? 1U : 0U;
        const std::uint32_t right = difference > 0xFFFFU ? 1U : 0U;
        split.set(kSpread[x / 2] | static_cast<std::size_t>(kSpread[y / 2]) << 1,
                  left | right << 1);
        count += left + right;
      }
    }
  }
  return count;
}

// A block has one value if its quarters have, and the same.
std::size_t Quadtree::find_level(std::size_t level, TileCells cells) {
  const BlockMap& quarters = split_[level - 2];
  BlockMap& split = split_[level - 1];
  split.clear();
  std::size_t count = 0;
  const std::size_t half = std::size_t{1} << (level - 1);
  for (std::size_t block = 0; block < kTileBytes >> (2 * level); ++block) {
    bool is_split = quarters.any_child(block);
    if (!is_split) {
      const std::size_t corner = cell_of_morton(block << (2 * level));
      const std::byte value = cells[corner];
      is_split = cells[corner + half] != value || cells[corner + half * kTileSide] != value ||
                 cells[corner + half * (kTileSide + 1)] != value;
    }
    if (is_split) {
      split.set(block, 1);
      ++count;
    }
  }
  return count;
}

// Every split block has four children; what is not split is a leaf, and single cells have no bit.
std::size_t Quadtree::coded_bytes(std::size_t value_count) const {
  std::size_t nodes = 1;  // with a bit
  std::size_t split = 0;
  for (std::size_t i = 0; i < kLevels; ++i) {
    nodes += i == 0 ? 0 : 4 * split_count_[i];
    split += split_count_[i];
  }
  const std::size_t leaves = 1 + 3 * split;
  return 1 + value_count + (nodes + leaves * symbol_bits(value_count) + 7) / 8;
}

// Goes by blocks of level 1. Where a block ends, the next one of the order begins, as large as its
// place in the order allows; the ones of the blocks that are split on the way to it are its prefix.
std::size_t Quadtree::write(TileCells cells, Palette& palette, std::span<std::byte> buffer) const {
  const auto values = palette.values();
  if (buffer.size() < coded_bytes(values.size())) {
    return 0;
  }
  buffer[0] = static_cast<std::byte>(values.size());
  std::ranges::copy(values, buffer.begin() + 1);
  BitWriter out(buffer.subspan(1 + values.size()));
  const unsigned bits = symbol_bits(values.size());
  for (std::size_t m = 0; m < kTileBytes;) {
    std::size_t level = m == 0 ? kLevels : static_cast<std::size_t>(std::countr_zero(m)) / 2;
    unsigned ones = 0;
    while (level > 0 && split_[level - 1].test(m >> (2 * level))) {
      --level;
      ++ones;
    }
    const std::size_t cell = cell_of_morton(m);
    const std::uint32_t symbol = palette.symbol_of(cells[cell]);
    const std::uint32_t prefix = (1U << ones) - 1;
    if (level > 0) {
      out.put(prefix << (bits + 1) | symbol, ones + 1 + bits);
      m += std::size_t{1} << (2 * level);
      continue;
    }
    out.put(prefix << bits | symbol, ones + bits);
    out.put(palette.symbol_of(cells[cell + 1]), bits);
    out.put(std::uint32_t{palette.symbol_of(cells[cell + kTileSide])} << bits |
                palette.symbol_of(cells[cell + kTileSide + 1]),
            2 * bits);
    m += 4;
  }
  return 1 + values.size() + out.finish();
}

}  // namespace iog::tile_coding
