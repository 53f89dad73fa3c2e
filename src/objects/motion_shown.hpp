// Determines whether the grid confirms the motion of a track. The grid confirms the motion if the
// places that the track has left are now free and the places that it has reached were open ground
// before.
//
// A filter alone cannot confirm motion. For example, rails and walls appear to move because their
// visible part moves with the car. The grid, however, remembers the previous state of each place.
#pragma once

#include <cstdint>
#include <span>

#include "objects/frame_hits.hpp"
#include "objects/grid_names.hpp"
#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/recent_hits.hpp"
#include "objects/track.hpp"

namespace iog::objects {

struct Hits {
  const FrameHits& now;
  const RecentHits& recent;
  std::span<const FrameHit> of_view;  // the array to which the track's indices refer
};

// Our car. Within blind_mm of it, no place can be seen to be left or reached.
struct OurCar {
  Point at{};
  Velocity velocity{};
  std::int32_t blind_mm = 0;
};

// Counts the good, bad and neutral places and stores the counts in `track.seen`. Compares the track
// and its hits with the youngest snapshot that is old enough to show motion. If the track is
// receding, also updates its trail. A moving track within blind_mm keeps its state: only
// contradictions and hits at places that it has left are bad.
void weigh_motion(std::uint64_t now_us, const OurCar& car, std::span<const std::uint16_t> numbers,
                  const Hits& hits, const GridNames& grid, Track& track);

// Returns true if enough places confirm the motion.
[[nodiscard]] bool is_shown(const Seen& seen);

// Takes a snapshot of the track if one is due.
void remember(std::uint64_t now_us, std::span<const std::uint16_t> numbers,
              std::span<const FrameHit> hits, Track& track);

}  // namespace iog::objects
