// Ranges. A tile has at most 1024 runs, a symbol at most 8 bits and a length at most 21. So the
// sums stay below 2^16, and one write stays below the 31 bits that BitWriter takes.
#include "tile_coding/runs.hpp"

#include <algorithm>

#include "tile_coding/bit_stream.hpp"
#include "tile_coding/run_ends.hpp"

namespace iog::tile_coding {
namespace {

// A length of b bits takes b - 1 zeros and its own b bits, where b is 32 less its leading zeros.
constexpr unsigned gamma_bits(std::size_t length) { return 63 - 2 * leading_zeros(length); }
static_assert(gamma_bits(1) == 1);
static_assert(gamma_bits(kTileBytes) == 21);

}  // namespace

void Runs::Builder::finish(Runs& runs, bool has_reference) const {
  runs.count_ = static_cast<std::size_t>(next_ - runs.list_.data());
  runs.length_bits_ = 63 * runs.count_ - 2 * leading_zeros_;  // the sum of gamma_bits()
  runs.has_reference_ = has_reference;
}

void Runs::find(TileCells cells, const CellMap& changes) {
  palette_.clear();
  Builder runs(*this);
  std::size_t begin = 0;
  changes.for_each([&](std::size_t end) {
    runs.add(palette_.symbol_of(cells[begin]), end - begin);
    begin = end;
  });
  runs.add(palette_.symbol_of(cells[begin]), kTileBytes - begin);
  runs.finish(*this, false);
}

void Runs::find(TileCells cells, const CellMap& changes, const CellMap& differences) {
  palette_.clear();
  Builder runs(*this);
  RunEnds run_ends;
  std::size_t begin = 0;
  const auto add = [&](bool is_value, std::size_t end) {
    runs.add(is_value ? palette_.symbol_of(cells[begin]) + 1 : 0, end - begin);
    begin = end;
  };
  for (std::size_t y = 0; y < kTileSide; ++y) {
    const RunEnds::Row ends = run_ends.next(changes.row(y), differences.row(y));
    for_each_bit(ends.of_values | ends.of_reference,
                 [&](std::size_t x) { add((ends.of_values >> x & 1U) != 0, y * kTileSide + x); });
  }
  add(run_ends.last_is_value(), kTileBytes);
  runs.finish(*this, true);
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
  const auto put = [&out](std::uint32_t code, unsigned bits, std::uint32_t cells) {
    const unsigned length = gamma_bits(cells);
    out.put((code << length) | cells, bits + length);
  };
  const auto list = std::span(list_).first(count_);
  std::uint32_t before = list[0].symbol;
  put(before, symbol_bits(symbol_count()), list[0].cells);
  const unsigned bits = symbol_bits(symbol_count() - 1);
  for (const Run& run : list.subspan(1)) {
    put(run.symbol - (run.symbol > before ? 1U : 0U), bits, run.cells);
    before = run.symbol;
  }
  return 1 + values.size() + out.finish();
}

}  // namespace iog::tile_coding
