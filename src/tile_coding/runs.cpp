// Bits: a tile has at most 1024 runs, a symbol at most 8 bits and a length at most 21, so the sums
// stay below 2^15 and one write below the 31 bits that BitWriter takes.
#include "tile_coding/runs.hpp"

#include <algorithm>
#include <bit>

#include "tile_coding/bit_stream.hpp"

namespace iog::tile_coding {
namespace {

constexpr unsigned gamma_bits(std::size_t length) {
  return 2 * static_cast<unsigned>(std::bit_width(length)) - 1;
}
static_assert(gamma_bits(1) == 1);
static_assert(gamma_bits(kTileBytes) == 21);

}  // namespace

void Runs::clear(bool has_reference) {
  palette_.clear();
  count_ = 0;
  length_bits_ = 0;
  has_reference_ = has_reference;
}

void Runs::add(std::uint16_t symbol, std::size_t cells) {
  list_[count_++] = {.symbol = symbol, .cells = static_cast<std::uint16_t>(cells)};
  length_bits_ += gamma_bits(cells);
}

void Runs::find(TileCells cells, const CellMap& changes) {
  clear(false);
  for (std::size_t begin = 0; begin < kTileBytes;) {
    const std::size_t end = changes.next(begin + 1);
    add(palette_.symbol_of(cells[begin]), end - begin);
    begin = end;
  }
}

void Runs::find(TileCells cells, const CellMap& changes, const CellMap& differences) {
  clear(true);
  for (std::size_t begin = 0; begin < kTileBytes;) {
    const std::size_t change = changes.next(begin + 1);
    const std::size_t difference = differences.next(begin);
    if (difference >= change) {
      add(0, difference - begin);
      begin = difference;
    } else {
      add(static_cast<std::uint16_t>(palette_.symbol_of(cells[begin]) + 1), change - begin);
      begin = change;
    }
  }
}

std::size_t Runs::coded_bytes() const {
  const std::size_t symbols = symbol_count();
  const std::size_t bits =
      symbol_bits(symbols) + (count_ - 1) * symbol_bits(symbols - 1) + length_bits_;
  return 1 + palette_.values().size() + (bits + 7) / 8;
}

std::size_t Runs::write(std::span<std::byte> buffer) const {
  const std::size_t bytes = coded_bytes();
  if (buffer.size() < bytes) {
    return 0;
  }
  const auto values = palette_.values();
  buffer[0] = static_cast<std::byte>(values.size());
  std::ranges::copy(values, buffer.begin() + 1);
  BitWriter out(buffer.subspan(1 + values.size()));
  unsigned bits = symbol_bits(symbol_count());
  std::uint32_t before = 0xFFFF;  // above every symbol: nothing is excluded
  for (const Run& run : std::span(list_).first(count_)) {
    const std::uint32_t code = run.symbol - (run.symbol > before ? 1U : 0U);
    const unsigned length = gamma_bits(run.cells);
    out.put((code << length) | run.cells, bits + length);
    before = run.symbol;
    bits = symbol_bits(symbol_count() - 1);
  }
  return 1 + values.size() + out.finish();
}

}  // namespace iog::tile_coding
