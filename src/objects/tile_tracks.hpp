// Lists the tracks that may claim hits in each tile of the window, so that each hit is compared
// with only a few tracks.
//
// Each tile can list up to kMostTracksOfATile tracks, in the order of their slots. If too many
// tracks overlap a tile, moving tracks have priority. A track that does not fit in the list is
// counted and claims no hits in this tile.
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
  // Returns the number of tracks that were not listed, summed over all tiles.
  std::uint32_t list(std::span<const Track> tracks, const ClaimGates& gates,
                     const window::Area& area);

  // Returns the list of tracks for the tile that contains `cell`, as slots in ascending order. The
  // cell must be in the window.
  [[nodiscard]] std::span<const std::uint8_t> near(geometry::Cell cell) const;
  // Returns true if the track may claim a hit at this place. The test is fast and rules out most
  // tracks.
  [[nodiscard]] bool may_take(std::size_t slot, Point place) const {
    return reaches_[slot].contains(place);
  }

 private:
  using Slots = std::array<std::uint8_t, kMostTracksOfATile>;
  std::uint32_t add(std::size_t track, const Bounds& bounds, const window::Area& area);
  // Inserts a slot into the ordered slots of a tile. The tile must not be full.
  void insert(std::size_t tile, std::uint8_t slot);

  // The counts are stored separately from the slots, so that they can be cleared quickly.
  std::array<std::uint8_t, window::kSlotCount> counts_{};
  std::array<Slots, window::kSlotCount> slots_{};
  std::array<Bounds, kMostTracks> reaches_{};  // of the listed tracks
};

}  // namespace iog::objects
