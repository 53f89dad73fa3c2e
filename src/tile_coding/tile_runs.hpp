// Divides a tile into runs, in row-major order. A run either equals a reference tile or has one
// value.
//
// A *stretch* is the cells between two changes of value. A run with a value starts at the first
// cell of a stretch that differs from the reference, and ends with the stretch. All cells outside
// such runs equal the reference. The reference of a self-contained tile is the unknown tile, all
// zeros.
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
  // If there is no reference, compares with the unknown tile.
  void find(TileCells cells, const std::optional<TileCells>& reference);

  // One byte per run in order: its value, or as_reference(). A run that equals the reference at the
  // beginning of the tile is left out. as_reference() pads the last word.
  [[nodiscard]] std::span<const std::uint32_t> fours() const {
    return std::span(values_).first((count_ + 3) / 4);
  }
  [[nodiscard]] std::uint8_t as_reference() const { return as_reference_; }

  // Writes where the runs start, by blocks of four cells by two rows. First comes one bit per
  // block, set if a run starts in it. Then each block with a set bit has one byte with a bit per
  // cell. Blocks and cells are in row-major order, the first in the lowest bit. Returns the number
  // of bytes written.
  static constexpr std::size_t kBlocks = kTileBytes / 8;
  static constexpr std::size_t kBlocksPerRow = kTileSide / 4;
  static constexpr std::size_t kSets = kBlocks / 8;  // bytes of the block bits
  static constexpr std::size_t kMostStartBytes = kSets + kBlocks;
  std::size_t write_starts(std::span<std::byte, kMostStartBytes> out) const;

 private:
  static_assert(kTileSide == 32, "a row of cells is a word of bits");

  alignas(16) std::array<std::uint32_t, kTileSide> starts_{};  // bit x of word y
  // Eight spare bytes, because writes of eight bytes can start at any place.
  alignas(8) std::array<std::uint32_t, kTileBytes / 4 + 2> values_{};
  std::size_t count_ = 0;
  std::uint8_t as_reference_ = 0;
};

}  // namespace iog::tile_coding
