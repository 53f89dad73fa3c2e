// Assigns the hits in or near a track's box to the track.
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
  // Sets the owner of each hit. The owner is a track whose gate contains the hit. If several gates
  // contain the hit, the owner is the track with the nearest box. Ties go to the track with the
  // lower slot number. Hits on standing cells are assigned only to moving tracks and to receding
  // tracks whose visible face may lie on standing cells. If a hit contradicts a track, the hit is
  // counted and is not assigned to this track. Returns the result of TileTracks::list().
  std::uint32_t take(const window::Area& area, Point car, std::span<Track> tracks,
                     std::span<FrameHit> hits);

 private:
  void take(Point car, std::span<Track> tracks, FrameHit& hit) const;

  ClaimGates gates_{};
  TileTracks near_{};
};

// Assigns a hit to `track`. Uses the track's velocity to predict the hit's position at the end of
// the frame.
void own(const Track& track, std::size_t slot, FrameHit& hit);

}  // namespace iog::objects
