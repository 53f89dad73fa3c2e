#include "tile_coding/quadtree.hpp"

#include <algorithm>
#include <bit>

#include "tile_coding/bit_stream.hpp"

namespace iog::tile_coding {
namespace {

// A number of five bits, spread: bit i is moved to bit 2 i.
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

// A Morton number has ten bits. Each half of them has a table of cell numbers; the cell of the
// whole is the sum of the two.
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

// By level: bit x is set if a block of this level can begin at cell x of a row.
constexpr std::array<std::uint32_t, Quadtree::kLevels> kLowestOfBlocks{
    0x55555555, 0x11111111, 0x01010101, 0x00010001, 0x00000001};

// The number of ones in a word whose ones are at least two places apart. The Cortex-A9 has no
// instruction for it.
constexpr std::size_t count_of_ones(std::uint32_t bits) {
  bits = (bits & 0x11111111U) + ((bits >> 2) & 0x11111111U);
  bits = (bits + (bits >> 4)) & 0x0F0F0F0FU;
  return (bits * 0x01010101U) >> 24;
}
static_assert(count_of_ones(0x55555555) == 16);
static_assert(count_of_ones(0x40000001) == 2);

}  // namespace

std::size_t cell_of_morton(std::size_t m) {
  return std::size_t{kHalves.lower[m % 32]} + kHalves.upper[m / 32];
}

// A block has one value if each of its quarters has one value and the four are equal. Two quarters
// side by side are compared where they touch: the lowest cell of the right one must not differ from
// the cell before it, that of the upper one not from the cell below it.
void Quadtree::find(const CellMap& changes, const CellMap& steps) {
  for (std::size_t level = 1; level <= kLevels; ++level) {
    const std::size_t side = std::size_t{1} << level;
    const std::size_t half = side / 2;
    std::size_t count = 0;
    for (std::size_t block = 0; block < kTileSide / side; ++block) {
      const std::size_t y = block * side;
      std::uint32_t right = changes.row(y) | changes.row(y + half);
      std::uint32_t left = steps.row(y + half);
      if (level > 1) {
        const BlockRows& quarters = split_[level - 2];
        const std::uint32_t split = quarters[2 * block] | quarters[2 * block + 1];
        right |= split;
        left |= split;
      }
      const std::uint32_t split = (left | right >> half) & kLowestOfBlocks[level - 1];
      split_[level - 1][block] = split;
      count += count_of_ones(split);
    }
    split_count_[level - 1] = count;
  }
}

// Every split block has four children. A block that is not split is a leaf. Single cells have no
// bit of their own.
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

// Goes through the leaves in Morton order, four single cells at once. Where a leaf ends, the next
// block begins; it is as large as its place in the order allows. If it is split, its first quarter
// is looked at, and so on. The ones of all blocks split on this way are the prefix of the leaf's
// code.
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
    const std::size_t cell = cell_of_morton(m);
    while (level > 0 && is_split(level, cell)) {
      --level;
      ++ones;
    }
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
