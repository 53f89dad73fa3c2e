// The runs of a tile against a reference: cells that are as in the reference, and cells of one
// value, row by row.
//
// A *stretch* is the cells from one change of value to the next. A run of a value starts at the
// first cell of a stretch that differs from the reference, and ends with the stretch. All that lies
// between such runs is as in the reference, and so is what comes before the first of them. A tile
// that stands by itself has the unknown tile for its reference, all zeros.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

class TileRuns {
 public:
  // Without a reference against the unknown tile.
  void find(TileCells cells, const std::optional<TileCells>& reference);

  // Of each run in order, but one as in the reference that begins with the tile, its value or
  // as_reference(). They come in fours, which as_reference() fills up.
  [[nodiscard]] std::span<const std::uint32_t> fours() const {
    return std::span(values_).first((count_ + 3) / 4);
  }
  [[nodiscard]] std::uint8_t as_reference() const { return as_reference_; }

  // Where they start, by blocks of four cells by two rows: a bit for each block, whether a run
  // starts in it, and then a byte for each block whose bit is set, with a bit for each of its
  // cells. The lowest bit is of the first block or cell, row by row. Returns the bytes written.
  static constexpr std::size_t kBlocks = kTileBytes / 8;
  static constexpr std::size_t kBlocksPerRow = kTileSide / 4;
  static constexpr std::size_t kSets = kBlocks / 8;  // bytes of the blocks' bits
  static constexpr std::size_t kMostStartBytes = kSets + kBlocks;
  std::size_t write_starts(std::span<std::byte, kMostStartBytes> out) const;

 private:
  static_assert(kTileSide == 32, "a row of cells is a word of bits");

  alignas(16) std::array<std::uint32_t, kTileSide> starts_{};  // bit x of word y
  // Eight bytes more, as eight are written at once from any place on.
  alignas(8) std::array<std::uint32_t, kTileBytes / 4 + 2> values_{};
  std::size_t count_ = 0;
  std::uint8_t as_reference_ = 0;
};

}  // namespace iog::tile_coding
