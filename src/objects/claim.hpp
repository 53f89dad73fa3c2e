// Assigns hits to the tracks whose boxes they are in or near.
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
  // Sets the owner of each hit: a track in whose gate the hit lies. If there are several, the track
  // with the nearest box wins; in a tie, the lower slot. Standing hits go only to moving tracks, or
  // to receding tracks whose visible face may be classified as standing. A track rejects and counts
  // hits that contradict it. Returns the result of TileTracks::list().
  std::uint32_t take(const window::Area& area, Point car, std::span<Track> tracks,
                     std::span<FrameHit> hits);

 private:
  void take(Point car, std::span<Track> tracks, FrameHit& hit) const;

  ClaimGates gates_{};
  TileTracks near_{};
};

// Assigns a hit to `track`, and moves it to the end of the frame with the velocity of the track.
void own(const Track& track, std::size_t slot, FrameHit& hit);

}  // namespace iog::objects
