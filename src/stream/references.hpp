// What a tile may be encoded against: the last cells of each tile that were sent by themselves,
// that is without a reference. The sender and its receivers keep the same cells (docs/spec.md 3.4).
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

// A reference is never older than this. So a receiver that has received one frame more than this is
// complete.
inline constexpr std::uint32_t kMaxReferenceAge = 7;  // frames

// Whether a tile with this encoding can be decoded without a reference.
[[nodiscard]] constexpr bool stands_by_itself(tile_coding::Encoding encoding) {
  return encoding != tile_coding::Encoding::kRunStartsSince;
}

class References {
 public:
  // Keeps a tile that is sent by itself. payload_bytes: the length in which it is sent.
  void keep(std::size_t tile, tile_coding::TileCells cells, std::uint32_t frame_number,
            std::size_t payload_bytes);

  // What has changed of a tile since then took so many bytes. If these are hardly fewer than the
  // tile took by itself, it is sent by itself the next time: that is shorter in the frames that
  // follow.
  void note_changes(std::size_t tile, std::size_t payload_bytes);

  // What is kept of a tile. Nothing if it was never sent by itself.
  [[nodiscard]] std::optional<tile_coding::Reference> find(std::size_t tile) const;

  // What a sender may encode the tile against in this frame. Nothing if the reference is too old,
  // or if too much has changed since. Nothing either in one of every kMaxReferenceAge + 1 frames;
  // which one depends on the tile, so that the tiles that must be sent by themselves are spread
  // evenly over the frames.
  [[nodiscard]] std::optional<tile_coding::Reference> usable(std::size_t tile,
                                                             std::uint32_t frame_number) const;

  void forget() { is_kept_.reset(); }

 private:
  std::array<std::array<std::byte, tile_coding::kTileBytes>, geometry::kTileCount> cells_{};
  std::array<std::uint32_t, geometry::kTileCount> frame_numbers_{};
  std::array<std::uint16_t, geometry::kTileCount> payload_bytes_{};
  std::bitset<geometry::kTileCount> is_kept_;
  std::bitset<geometry::kTileCount> is_spent_;
};

}  // namespace iog::stream
