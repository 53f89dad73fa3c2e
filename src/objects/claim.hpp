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
  // Begins a frame. Until its last hit has been taken, the tracks must not change. Returns the
  // result of TileTracks::list().
  std::uint32_t begin(const window::Area& area, std::span<const Track> tracks);

  // Sets the owner of a hit. The owner is a track whose gate contains the hit. If several gates
  // contain the hit, the owner is the track with the nearest box. Ties go to the track with the
  // lower slot number. Hits on standing cells are assigned only to moving tracks and to receding
  // tracks whose visible face may lie on standing cells. If a hit contradicts a track, the hit is
  // marked and is not assigned to this track. Several cores may take different hits. A hit may be
  // taken again.
  void take(Point car, std::span<const Track> tracks, FrameHit& hit) const;
  // Counts the hits that contradict each track. Call this function once, after take().
  void count_contradictions(Point car, std::span<Track> tracks,
                            std::span<const FrameHit> hits) const;

 private:
  // Returns the slot of the owner, or kNobody. Calls contradict(slot) for each track that the hit
  // contradicts.
  template <typename Contradict>
  [[nodiscard]] std::int16_t owner_of(Point car, std::span<const Track> tracks, const FrameHit& hit,
                                      Contradict&& contradict) const;

  ClaimGates gates_{};
  TileTracks near_{};
};

// Assigns a hit to `track`. Uses the track's velocity to predict the hit's position at the end of
// the frame.
void own(const Track& track, std::size_t slot, FrameHit& hit);

}  // namespace iog::objects
