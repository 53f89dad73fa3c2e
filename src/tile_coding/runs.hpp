// A tile as runs of cells, row by row: of one value each, or as they are in a reference tile.
//
// A run's symbol is the number of its value in the palette, from 0. For a tile with a reference,
// symbol 0 means "as in the reference", and the values count from 1. With n symbols in use, a list
// of runs is coded as
//
//   u8        number of values
//   int8 ...  the values
//   bits      for each run its symbol, then its length in Elias' gamma code: as many zeros as the
//             length has bits behind its highest, then the length itself
//   bits      zeros up to the next byte
//
// The first symbol has ceil(log2 n) bits. No run has the symbol of the run before it, so all others
// have ceil(log2(n - 1)) bits, and a symbol above that of the run before is written less one. The
// lengths add up to the cells of the tile. Elias (1975): Universal codeword sets and
// representations of the integers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tile_coding/cell_map.hpp"
#include "tile_coding/palette.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

class Runs {
 public:
  // Finds the runs of one value. `changes` are those of the cells. No cell is -128.
  void find(TileCells cells, const CellMap& changes);

  // Finds runs of one value and runs that are as in a reference; the latter where they are at least
  // as long. `differences` are those from the reference.
  void find(TileCells cells, const CellMap& changes, const CellMap& differences);

  // The bytes of the code of what find() has found.
  [[nodiscard]] std::size_t coded_bytes() const;

  // Returns coded_bytes(), or 0 if the buffer is shorter.
  std::size_t write(std::span<std::byte> buffer) const;

  [[nodiscard]] Palette& palette() { return palette_; }

 private:
  struct Run {
    std::uint16_t symbol;
    std::uint16_t cells;
  };

  // Fills the list. A Builder is held in registers. The members of Runs are not, because a store to
  // the palette's bytes may alias them.
  class Builder {
   public:
    explicit Builder(Runs& runs) : next_{runs.list_.data()} {}
    void add(unsigned symbol, std::size_t cells) {
      *next_++ = {.symbol = static_cast<std::uint16_t>(symbol),
                  .cells = static_cast<std::uint16_t>(cells)};
      leading_zeros_ += leading_zeros(cells);
    }
    void finish(Runs& runs, bool has_reference) const;

   private:
    Run* next_;
    std::size_t leading_zeros_ = 0;  // of all lengths
  };

  [[nodiscard]] std::size_t symbol_count() const {
    return palette_.values().size() + (has_reference_ ? 1 : 0);
  }

  Palette palette_;
  std::array<Run, kTileBytes> list_{};
  std::size_t count_ = 0;
  std::size_t length_bits_ = 0;  // of all gamma codes
  bool has_reference_ = false;
};

}  // namespace iog::tile_coding
