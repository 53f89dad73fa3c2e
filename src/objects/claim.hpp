// Tracks take the hits in and around their boxes.
#pragma once

#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/tile_tracks.hpp"
#include "objects/track.hpp"
#include "window/area.hpp"

namespace iog::objects {

class Claim {
 public:
  // Of each hit the owner: of the tracks within whose gate it lies that whose box is nearest, of
  // equals that of the lower slot. A standing hit goes to a moving track, or to a receding one
  // whose face may stand. A track that a hit contradicts does not take it, and records that.
  // Returns what list() does.
  std::uint32_t take(const window::Area& area, Point car, std::span<Track> tracks,
                     std::span<FrameHit> hits);

 private:
  void take(Point car, std::span<Track> tracks, FrameHit& hit) const;

  ClaimGates gates_{};
  TileTracks near_{};
};

// `track` takes a hit, which is moved to the frame's end by its speed.
void own(const Track& track, std::size_t slot, FrameHit& hit);

}  // namespace iog::objects
