// Divides a tile into runs, in row-major order. A run either matches the reference tile or repeats
// a single value.
//
// A *stretch* consists of the cells between two changes of value. Within a stretch, a run with a
// value starts at the first cell that differs from the reference, and ends at the end of the
// stretch. All cells outside these runs equal the reference. For a self-contained tile, the
// reference is the unknown tile, in which all cells are zero.
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
  // Finds the runs of a tile. If no reference is given, the tile is compared with the unknown tile.
  void find(TileCells cells, const std::optional<TileCells>& reference);

  // Returns one byte per run, in the order of the runs. The byte is the value of the run, or
  // as_reference() if the run equals the reference. A run at the beginning of the tile is omitted
  // if it equals the reference. The last word is padded with the value of as_reference().
  [[nodiscard]] std::span<const std::uint32_t> fours() const {
    return std::span(values_).first((count_ + 3) / 4);
  }
  [[nodiscard]] std::uint8_t as_reference() const { return as_reference_; }

  // Writes the positions at which runs start. For this purpose, the tile is divided into blocks
  // that are four cells wide and two rows high. The output starts with one bit per block. The bit
  // is set if a run starts in the block. These bits are followed by one byte for each block whose
  // bit is set. Each byte contains one bit per cell. Blocks and cells are in row-major order,
  // starting at the lowest bit. Returns the number of bytes written.
  static constexpr std::size_t kBlocks = kTileBytes / 8;
  static constexpr std::size_t kBlocksPerRow = kTileSide / 4;
  static constexpr std::size_t kSets = kBlocks / 8;  // number of bytes with block bits
  static constexpr std::size_t kMostStartBytes = kSets + kBlocks;
  std::size_t write_starts(std::span<std::byte, kMostStartBytes> out) const;

 private:
  static_assert(kTileSide == 32, "a row of cells is a word of bits");

  alignas(16) std::array<std::uint32_t, kTileSide> starts_{};  // bit x of word y is cell (x, y)
  // The array has eight spare bytes at the end because a write of eight bytes can start at any
  // cell.
  alignas(8) std::array<std::uint32_t, kTileBytes / 4 + 2> values_{};
  std::size_t count_ = 0;
  std::uint8_t as_reference_ = 0;
};

}  // namespace iog::tile_coding
