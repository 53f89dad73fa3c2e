// Each decoder ends, because a run or a block has at least one cell and is refused if it does not
// fit.
#include "tile_coding/older_encodings.hpp"

#include <algorithm>
#include <bit>

#include "tile_coding/bit_stream.hpp"
#include "tile_coding/values.hpp"

namespace iog::tile_coding {
namespace {

constexpr unsigned kMaxLengthBits = kTileSideLog2 * 2;  // behind the highest of a length

// Bits that tell `count` symbols apart: 0 for one symbol.
unsigned symbol_bits(std::size_t count) {
  const auto most = static_cast<std::uint32_t>(count - 1);
  return count < 2 ? 0U : static_cast<unsigned>(32 - std::countl_zero(most));
}

// Reads Elias' gamma code; 0 if it is not the code of a length.
std::size_t read_length(BitReader& in) {
  unsigned zeros = 0;
  while (!in.bit()) {
    if (++zeros > kMaxLengthBits) {
      return 0;
    }
  }
  return (std::size_t{1} << zeros) | in.bits(zeros);
}

// Where cell m of the Morton order is in a tile: bits 0, 2, 4 ... of m are those of x.
std::size_t cell_of_morton(std::size_t m) {
  std::size_t x = 0;
  std::size_t y = 0;
  for (std::size_t bit = 0; bit < kTileSideLog2; ++bit) {
    x |= (m >> (2 * bit) & 1U) << bit;
    y |= (m >> (2 * bit + 1) & 1U) << bit;
  }
  return y * kTileSide + x;
}

void fill_block(MutableTileCells cells, std::size_t m, std::size_t level, std::byte value) {
  const std::size_t corner = cell_of_morton(m);
  const std::size_t side = std::size_t{1} << level;
  for (std::size_t y = 0; y < side; ++y) {
    std::ranges::fill(cells.subspan(corner + y * kTileSide, side), value);
  }
}

}  // namespace

// With a reference, symbol 0 stands for the reference's cells, and the values count from 1. No run
// has the symbol of the run before it; so a symbol above that is written less one.
bool decode_run_length(std::span<const std::byte> payload,
                       const std::optional<TileCells>& reference, MutableTileCells cells) {
  const std::optional<Values> values = take_values(payload);
  const std::size_t first_value = reference ? 1 : 0;
  const std::size_t symbols = values ? values->list.size() + first_value : 0;
  if (symbols == 0) {
    return false;
  }
  BitReader in(values->rest);
  unsigned bits = symbol_bits(symbols);
  std::size_t before = symbols;  // above every symbol: nothing is excluded
  for (std::size_t begin = 0; begin < kTileBytes;) {
    const std::size_t code = in.bits(bits);
    const std::size_t symbol = code + (code >= before ? 1 : 0);
    const std::size_t length = read_length(in);
    if (!in.ok() || symbol >= symbols || length == 0 || length > kTileBytes - begin) {
      return false;
    }
    const auto run = cells.subspan(begin, length);
    if (symbol < first_value) {
      std::ranges::copy(reference->subspan(begin, length), run.begin());
    } else {
      std::ranges::fill(run, values->list[symbol - first_value]);
    }
    before = symbol;
    bits = symbol_bits(symbols - 1);
    begin += length;
  }
  return in.ends_here();
}

bool decode_quadtree(std::span<const std::byte> payload, MutableTileCells cells) {
  const std::optional<Values> values = take_values(payload);
  if (!values || values->list.empty()) {
    return false;
  }
  BitReader in(values->rest);
  const unsigned bits = symbol_bits(values->list.size());
  for (std::size_t m = 0; m < kTileBytes;) {
    std::size_t level = m == 0 ? kTileSideLog2 : static_cast<std::size_t>(std::countr_zero(m)) / 2;
    while (level > 0 && in.bit()) {
      --level;
    }
    const std::size_t symbol = in.bits(bits);
    if (!in.ok() || symbol >= values->list.size()) {
      return false;
    }
    fill_block(cells, m, level, values->list[symbol]);
    m += std::size_t{1} << (2 * level);
  }
  return in.ends_here();
}

}  // namespace iog::tile_coding
