// Lists, for each tile of the window, the tracks that may take hits there, so that a hit is
// compared with few tracks.
//
// A tile has room for kMostTracksOfATile tracks, in the order of slots. If there are more tracks,
// moving tracks are listed first. A track that does not fit is counted and takes no hits in this
// tile.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/cell.hpp"
#include "objects/claim_gate.hpp"
#include "objects/plane.hpp"
#include "objects/track.hpp"
#include "window/area.hpp"

namespace iog::objects {

class TileTracks {
 public:
  // Returns the number of tracks that did not fit, summed over all tiles.
  std::uint32_t list(std::span<const Track> tracks, const ClaimGates& gates,
                     const window::Area& area);

  // Returns the slots of the tracks listed for the tile of a cell, in ascending order. The cell
  // must be in the window.
  [[nodiscard]] std::span<const std::uint8_t> near(geometry::Cell cell) const;
  // Whether the track may take a hit at this place. This is a fast test that rules out most tracks.
  [[nodiscard]] bool may_take(std::size_t slot, Point place) const {
    return reaches_[slot].contains(place);
  }

 private:
  using Slots = std::array<std::uint8_t, kMostTracksOfATile>;
  std::uint32_t add(std::size_t track, const Bounds& bounds, const window::Area& area);
  // Inserts a slot into the ordered slots of a tile. The tile must have room for it.
  void insert(std::size_t tile, std::uint8_t slot);

  // Stored separately from the slots, so that clearing the counts is fast.
  std::array<std::uint8_t, window::kSlotCount> counts_{};
  std::array<Slots, window::kSlotCount> slots_{};
  std::array<Bounds, kMostTracks> reaches_{};  // of the listed tracks
};

}  // namespace iog::objects
