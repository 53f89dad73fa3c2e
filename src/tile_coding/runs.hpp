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

// Of one value each. Finding tells how long the code is, by counting; only the tile that is sent so
// is gone through run by run.
class Runs {
 public:
  // `changes` and `steps` are those of the cells. No cell is -128.
  void find(TileCells cells, const CellMap& changes, const CellMap& steps);

  // The bytes of the code of what find() has found.
  [[nodiscard]] std::size_t coded_bytes() const;

  // What find() was given last. Returns coded_bytes(), or 0 if the buffer is shorter.
  std::size_t write(TileCells cells, const CellMap& changes, std::span<std::byte> buffer) const;

  // Has all values of the cells, in the order in which they come.
  [[nodiscard]] Palette& palette() { return palette_; }

 private:
  Palette palette_;
  Parts runs_;
};

// Of one value each, or as they are in a reference; the latter where they are at least as long.
// What is found is mostly sent, so the runs are kept.
class RunsSince {
 public:
  // `changes` are those of the cells, `differences` those from the reference. No cell is -128.
  void find(TileCells cells, const CellMap& changes, const CellMap& differences);

  [[nodiscard]] std::size_t coded_bytes() const;
  std::size_t write(std::span<std::byte> buffer) const;

 private:
  // A word, so that it is stored and loaded at once: the symbol above, the cells below.
  static constexpr int kSymbolShift = 16;
  using Run = std::uint32_t;

  Palette palette_;
  Parts runs_;
  std::array<Run, kTileBytes> list_{};
};

}  // namespace iog::tile_coding
