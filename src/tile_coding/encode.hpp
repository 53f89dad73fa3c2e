// Encodes the cells of a tile for sending.
//
// A payload is never longer than the 1024 bytes of the raw encoding. Encoding takes a few passes
// over the cells and two passes over the runs, so the encoding time is bounded for any content.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "tile_coding/symbol_packing.hpp"
#include "tile_coding/tile_cells.hpp"
#include "tile_coding/tile_runs.hpp"

namespace iog::tile_coding {

// Wire values (docs/spec.md 3.4).
enum class Encoding : std::uint8_t {
  kRaw = 0,             // one byte per cell
  kRunStarts = 4,       // the positions at which runs start, and the values of the runs
  kRunStartsSince = 5,  // u8 age of the reference in frames, then run starts relative to it
};
inline constexpr std::size_t kEncodingCount = 6;  // highest value plus one

// A tile from an earlier frame. The receiver should already have this tile.
struct Reference {
  TileCells cells;
  std::uint32_t frame_number;
};

struct EncodedTile {
  Encoding encoding;
  std::size_t bytes;
};

// Encodes tiles. Intermediate data is stored in the object because it would take up too much stack
// space.
class Encoder {
 public:
  // Encodes a tile. Writes kRunStartsSince if a reference is given, and kRunStarts otherwise. If
  // the result could be longer than the raw encoding, writes kRaw instead. The reference must be at
  // most 255 frames old. No cell may have the value -128.
  [[nodiscard]] EncodedTile encode(TileCells cells, std::uint32_t frame_number,
                                   const std::optional<Reference>& reference,
                                   MutableTileCells payload);

 private:
  [[nodiscard]] std::size_t number_values(std::span<std::byte, kMostAlternatives> values);
  [[nodiscard]] std::size_t most_symbol_bytes(std::size_t alternatives) const;
  [[nodiscard]] std::uint32_t symbols_of(std::uint32_t four) const;
  [[nodiscard]] std::size_t write_symbols(std::uint32_t alternatives, std::span<std::byte> out);

  alignas(16) std::array<std::uint8_t, 256> symbols_{};            // symbol of each cell value
  alignas(16) std::array<std::uint32_t, kTileBytes / 4> fours_{};  // symbols of four runs per word
  TileRuns runs_;
};

}  // namespace iog::tile_coding
