// By tile of the window the tracks that may take hits there: so a hit asks few of them.
//
// Of a tile kMostTracksOfATile, in the order of their slots; if there are more, those that move
// have room first. What has none is counted, and takes nothing in this tile.
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
  // Returns how many tracks found no room in a tile, one for each tile.
  std::uint32_t list(std::span<const Track> tracks, const ClaimGates& gates,
                     const window::Area& area);

  // The slots of the tracks of the tile of a cell of the window, in their order.
  [[nodiscard]] std::span<const std::uint8_t> near(geometry::Cell cell) const;
  // Whether a hit at a place may be taken by one of them. Most are ruled out by that.
  [[nodiscard]] bool may_take(std::size_t slot, Point place) const {
    return reaches_[slot].contains(place);
  }

 private:
  using Slots = std::array<std::uint8_t, kMostTracksOfATile>;
  std::uint32_t add(std::size_t track, const Bounds& bounds, const window::Area& area);
  // Into a tile's slots in their order. There is room.
  void insert(std::size_t tile, std::uint8_t slot);

  // Apart from the slots, so that all are soon 0.
  std::array<std::uint8_t, window::kSlotCount> counts_{};
  std::array<Slots, window::kSlotCount> slots_{};
  std::array<Bounds, kMostTracks> reaches_{};  // of those that are listed
};

}  // namespace iog::objects
