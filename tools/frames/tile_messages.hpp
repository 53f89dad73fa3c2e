// The tiles of one grid: out of the messages of a frame, and against those of earlier frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "stream/references.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/tile_cells.hpp"
#include "tools/frames/message_counts.hpp"
#include "tools/frames/tile_set.hpp"

namespace iog::tools {

using TileBytes = std::array<std::byte, tile_coding::kTileBytes>;

// Decodes the tiles of a grid, frame by frame, and keeps what later ones refer to.
class TileDecoder {
 public:
  explicit TileDecoder(stream::Storage storage)
      : storage_(storage), references_(std::make_unique<stream::References>()) {}

  // False, and counted, if that is no tile of this storage. Nothing refers to such a tile then.
  [[nodiscard]] bool decode(const stream::TileRecord& record, std::uint32_t frame_number,
                            TileBytes& cells, MessageCounts& counts);

  void forget() { references_->forget(); }

  // From now on every tile stands by itself, so none is kept for later ones.
  void keep_none() { keeps_references_ = false; }

 private:
  stream::Storage storage_;
  bool keeps_references_ = true;
  std::unique_ptr<stream::References> references_;
};

// The messages of tiles of one grid in one frame. They are decoded when the frame is handed over:
// frames are in order by then, and so are the tiles that others refer to.
class TileMessages {
 public:
  // Stores the body of a message that stream::read_tiles() has accepted. Returns false if there are
  // more messages than the grid has tiles, or if an earlier message of the frame has another grid.
  [[nodiscard]] bool take(const stream::TilesHeader& header, const geometry::Grid& grid,
                          std::span<const std::byte> body);
  // The grid that the messages describe. Nothing if no message has come.
  [[nodiscard]] std::optional<geometry::Grid> grid() const {
    return bodies_.empty() ? std::nullopt : std::optional(grid_);
  }

  // Whether every tile of the grid has been spoken of.
  [[nodiscard]] bool are_complete() const { return spoken_of_.all(); }

  struct Tiles {
    TileSet valid;  // all that were spoken of, but for those that could not be decoded
    TileSet known;  // of these, those that came
  };
  using TileHandler = std::function<void(const stream::TileRecord&, const TileBytes&)>;
  // Calls on_tile for each that can be decoded.
  [[nodiscard]] Tiles decode(TileDecoder& decoder, std::uint32_t frame_number,
                             MessageCounts& counts, const TileHandler& on_tile) const;

 private:
  geometry::Grid grid_;
  TileSet spoken_of_;  // and all that are beyond the grid
  std::vector<std::vector<std::byte>> bodies_;
};

}  // namespace iog::tools
