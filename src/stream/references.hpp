// Stores the reference tiles for difference encoding. The reference of a tile is its latest
// self-contained version. The sender and the receivers store the same tiles (docs/spec.md 3.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geometry/grid.hpp"
#include "tile_coding/encode.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::stream {

// The maximum age of a reference. A receiver has all tiles after kMaxReferenceAge + 1 frames.
inline constexpr std::uint32_t kMaxReferenceAge = 7;  // in frames

// Returns true if tiles with this encoding are self-contained.
[[nodiscard]] constexpr bool stands_by_itself(tile_coding::Encoding encoding) {
  return encoding != tile_coding::Encoding::kRunStartsSince;
}

class References {
 public:
  // Stores a tile that was sent in self-contained form. `payload_bytes` is the length of the tile's
  // payload.
  void keep(std::size_t tile, tile_coding::TileCells cells, std::uint32_t frame_number,
            std::size_t payload_bytes);

  // Records the payload length of a tile that was encoded as the difference from its reference. If
  // this length exceeds seven eighths of the self-contained length, the tile is sent in
  // self-contained form the next time. Later versions of the tile then differ less from the new
  // reference than from the old one, and are encoded in fewer bytes.
  void note_changes(std::size_t tile, std::size_t payload_bytes);

  // Returns the stored reference of a tile. Returns std::nullopt if no self-contained version of
  // the tile has ever been sent.
  [[nodiscard]] std::optional<tile_coding::Reference> find(std::size_t tile) const;

  // Returns the reference that a sender may use for a tile in a frame. Returns std::nullopt if the
  // reference is too old, or if the tile has changed too much since its reference was sent. The
  // function also returns std::nullopt once every kMaxReferenceAge + 1 frames, so that each tile is
  // regularly sent in self-contained form. The tile number determines in which frame this happens,
  // so self-contained tiles are spread evenly over the frames.
  [[nodiscard]] std::optional<tile_coding::Reference> usable(std::size_t tile,
                                                             std::uint32_t frame_number) const;

  void forget() { is_kept_.fill(false); }

 private:
  std::array<std::array<std::byte, tile_coding::kTileBytes>, geometry::kTileCount> cells_{};
  std::array<std::uint32_t, geometry::kTileCount> frame_numbers_{};
  std::array<std::uint16_t, geometry::kTileCount> payload_bytes_{};
  // Not bits, so that one core may store a tile while other cores read other tiles.
  std::array<bool, geometry::kTileCount> is_kept_{};
  std::array<bool, geometry::kTileCount> is_spent_{};
};

}  // namespace iog::stream
