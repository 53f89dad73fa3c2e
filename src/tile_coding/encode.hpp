// From a tile's cells to what is sent of them.
//
// A payload never exceeds the 1024 bytes of the raw one. Encoding is a few passes over the cells
// and two over the runs: its time has a bound, whatever they are.
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

// The values are on the wire (docs/spec.md 3.4).
enum class Encoding : std::uint8_t {
  kRaw = 0,             // one byte a cell
  kRunStarts = 4,       // where runs start, and their values
  kRunStartsSince = 5,  // u8 frames since the reference, then run starts against it
};
inline constexpr std::size_t kEncodingCount = 6;  // the highest and those below it

// A tile as it was in an earlier frame that the receiver is meant to have.
struct Reference {
  TileCells cells;
  std::uint32_t frame_number;
};

struct EncodedTile {
  Encoding encoding;
  std::size_t bytes;
};

// Holds what an encoding is made from, so that no stack has to.
class Encoder {
 public:
  // Writes kRunStartsSince if there is a reference, at most 255 frames older than the frame, else
  // kRunStarts; raw where these might be longer. No cell is -128.
  [[nodiscard]] EncodedTile encode(TileCells cells, std::uint32_t frame_number,
                                   const std::optional<Reference>& reference,
                                   MutableTileCells payload);

 private:
  [[nodiscard]] std::size_t number_values(std::span<std::byte, kMostAlternatives> values);
  [[nodiscard]] std::size_t most_symbol_bytes(std::size_t alternatives) const;
  [[nodiscard]] std::uint32_t symbols_of(std::uint32_t four) const;
  [[nodiscard]] std::size_t write_symbols(std::uint32_t alternatives, std::span<std::byte> out);

  alignas(16) std::array<std::uint8_t, 256> symbols_{};            // by value
  alignas(16) std::array<std::uint32_t, kTileBytes / 4> fours_{};  // of the runs: their symbols
  TileRuns runs_;
};

}  // namespace iog::tile_coding
