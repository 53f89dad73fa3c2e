// From a tile's cells to the shortest of its encodings.
//
// A payload never exceeds the 1024 bytes of the raw one. Encoding is a few passes over the cells:
// its time has a bound, whatever they are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "tile_coding/cell_map.hpp"
#include "tile_coding/quadtree.hpp"
#include "tile_coding/runs.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

// The values are on the wire.
enum class Encoding : std::uint8_t {
  kRaw = 0,           // one byte a cell
  kRunLength = 1,     // tile_coding/runs.hpp
  kQuadtree = 2,      // tile_coding/quadtree.hpp
  kChangedSince = 3,  // u32 frame number, big endian, then runs against the tile of that frame
};
inline constexpr std::size_t kEncodingCount = 4;

// A tile as it was in an earlier frame that the receiver is meant to have.
struct Reference {
  TileCells cells;
  std::uint32_t frame_number;
  std::size_t bytes = 0;  // of its payload, when it was sent
};

struct EncodedTile {
  Encoding encoding;
  std::size_t bytes;
};

// Holds what an encoding is made from, so that no stack has to.
class Encoder {
 public:
  using Sizes = std::array<std::size_t, kEncodingCount>;

  // Writes the shortest encoding, the first of equally short ones. No cell is -128. What has
  // changed since the reference is taken at once if it is not longer than the reference's own
  // payload was: what the tile would take by itself now is hardly less, and finding it takes half
  // of the time.
  [[nodiscard]] EncodedTile encode(TileCells cells, const std::optional<Reference>& reference,
                                   MutableTileCells payload);

  // Writes this encoding if it is not longer than a raw tile, else a raw one. kChangedSince without
  // a reference is raw, too.
  [[nodiscard]] EncodedTile encode_as(Encoding encoding, TileCells cells,
                                      const std::optional<Reference>& reference,
                                      MutableTileCells payload);

  // What each encoding of the last tile took or would have taken, if it was not taken at once;
  // without a reference the last one is that of a raw tile.
  [[nodiscard]] const Sizes& sizes() const { return sizes_; }

 private:
  void survey_since(TileCells cells, const std::optional<Reference>& reference);
  void survey_alone(TileCells cells);
  [[nodiscard]] std::size_t write(Encoding encoding, TileCells cells,
                                  const std::optional<Reference>& reference,
                                  MutableTileCells payload);

  CellMap changes_;
  CellMap steps_;
  CellMap differences_;
  Runs runs_;
  RunsSince runs_since_;
  Quadtree quadtree_;
  Sizes sizes_{};
};

}  // namespace iog::tile_coding
