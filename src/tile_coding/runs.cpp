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

std::size_t code_bytes(std::size_t values, std::size_t symbols, const Parts& runs) {
  const std::size_t symbol_sum = symbol_bits(symbols) + (runs.count - 1) * symbol_bits(symbols - 1);
  const std::size_t length_sum = runs.count + 2 * runs.log2_sum;
  return 1 + values + (symbol_sum + length_sum + 7) / 8;
}

// Writes runs one after the other. The buffer has room for all of them.
class RunWriter {
 public:
  RunWriter(const Palette& palette, std::size_t symbols, std::span<std::byte> buffer)
      : out_{buffer.subspan(1 + palette.values().size())},
        bits_{symbol_bits(symbols)},
        later_bits_{symbol_bits(symbols - 1)} {
    buffer[0] = static_cast<std::byte>(palette.values().size());
    std::ranges::copy(palette.values(), buffer.begin() + 1);
  }

  // The next run.
  void put(std::uint32_t symbol, std::size_t cells) {
    const unsigned length = gamma_bits(cells);
    const std::uint32_t code = symbol - (symbol > before_ ? 1U : 0U);
    out_.put(code << length | static_cast<std::uint32_t>(cells), bits_ + length);
    before_ = symbol;
    bits_ = later_bits_;
  }

  // Returns the bytes written behind the values.
  std::size_t finish() { return out_.finish(); }

 private:
  BitWriter out_;
  unsigned bits_;
  unsigned later_bits_;
  std::uint32_t before_ = 0xFFFF'FFFF;  // above all symbols: the first is written as it is
};

}  // namespace

// A value that comes for the first time differs from the cell before it and from the cell below.
void Runs::find(TileCells cells, const CellMap& changes, const CellMap& steps) {
  palette_.clear();
  const auto note_row = [&](std::size_t y, std::uint32_t bits) {
    for_each_bit(bits, [&](std::size_t x) {
      static_cast<void>(palette_.symbol_of(cells[y * kTileSide + x]));
    });
  };
  note_row(0, changes.row(0) | 1U);
  for (std::size_t y = 1; y < kTileSide; ++y) {
    note_row(y, changes.row(y) & steps.row(y));
  }
  runs_ = changes.parts();
}

std::size_t Runs::coded_bytes() const {
  const std::size_t values = palette_.values().size();
  return code_bytes(values, values, runs_);
}

std::size_t Runs::write(TileCells cells, const CellMap& changes,
                        std::span<std::byte> buffer) const {
  if (buffer.size() < coded_bytes()) {
    return 0;
  }
  const std::size_t values = palette_.values().size();
  RunWriter out(palette_, values, buffer);
  std::size_t begin = 0;
  const auto end_at = [&](std::size_t end) {
    out.put(palette_.known_symbol_of(cells[begin]), end - begin);
    begin = end;
  };
  changes.for_each(end_at);
  end_at(kTileBytes);
  return 1 + values + out.finish();
}

// The list's end and the sums are held in registers: a store to the palette's bytes may alias what
// is a member.
void RunsSince::find(TileCells cells, const CellMap& changes, const CellMap& differences) {
  palette_.clear();
  RunEnds run_ends;
  Run* next = list_.data();
  std::size_t begin = 0;
  std::size_t zeros = 0;  // before the highest bit of all lengths
  const auto add = [&](bool is_value, std::size_t end) {
    const std::uint32_t symbol = is_value ? palette_.symbol_of(cells[begin]) + 1U : 0U;
    *next++ = symbol << kSymbolShift | static_cast<Run>(end - begin);
    zeros += leading_zeros(end - begin);
    begin = end;
  };
  for (std::size_t y = 0; y < kTileSide; ++y) {
    const RunEnds::Row ends = run_ends.next(changes.row(y), differences.row(y));
    for_each_bit(ends.of_values | ends.of_reference,
                 [&](std::size_t x) { add((ends.of_values >> x & 1U) != 0, y * kTileSide + x); });
  }
  add(run_ends.last_is_value(), kTileBytes);
  runs_.count = static_cast<std::size_t>(next - list_.data());
  runs_.log2_sum = 31 * runs_.count - zeros;
}

std::size_t RunsSince::coded_bytes() const {
  const std::size_t values = palette_.values().size();
  return code_bytes(values, values + 1, runs_);
}

std::size_t RunsSince::write(std::span<std::byte> buffer) const {
  if (buffer.size() < coded_bytes()) {
    return 0;
  }
  const std::size_t values = palette_.values().size();
  RunWriter out(palette_, values + 1, buffer);
  for (const Run run : std::span(list_).first(runs_.count)) {
    out.put(run >> kSymbolShift, run & ((1U << kSymbolShift) - 1));
  }
  return 1 + values + out.finish();
}

}  // namespace iog::tile_coding
