// Of each tile the last one that was sent by itself: what a later one may be encoded against. The
// sender and its receivers keep the same (docs/spec.md 3.4).
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "geometry/grid.hpp"
#include "tile_coding/encode.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::stream {

// No tile refers to a frame more than so many before its own, so that a receiver that has taken in
// one frame more is complete.
inline constexpr std::uint32_t kMaxReferenceAge = 7;  // frames

// Whether a tile with this encoding is understood without any other.
[[nodiscard]] constexpr bool stands_by_itself(tile_coding::Encoding encoding) {
  return encoding != tile_coding::Encoding::kChangedSince;
}

class References {
 public:
  // payload_bytes: in which it was sent.
  void keep(std::size_t tile, tile_coding::TileCells cells, std::uint32_t frame_number,
            std::size_t payload_bytes);

  // What is kept of a tile, if anything.
  [[nodiscard]] std::optional<tile_coding::Reference> find(std::size_t tile) const;

  // What a sender may encode the tile against in this frame. Nothing if that is too old; nor in one
  // frame of kMaxReferenceAge + 1, another for each tile, so that the tiles that have to be sent by
  // themselves spread over the frames.
  [[nodiscard]] std::optional<tile_coding::Reference> usable(std::size_t tile,
                                                             std::uint32_t frame_number) const;

  void forget() { is_kept_.reset(); }

 private:
  std::array<std::array<std::byte, tile_coding::kTileBytes>, geometry::kTileCount> cells_{};
  std::array<std::uint32_t, geometry::kTileCount> frame_numbers_{};
  std::array<std::uint16_t, geometry::kTileCount> payload_bytes_{};
  std::bitset<geometry::kTileCount> is_kept_;
};

}  // namespace iog::stream
