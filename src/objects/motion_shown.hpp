// Determines whether the grid confirms the motion of a track. The grid confirms it if places that
// the track has left are now free, and places that the track has reached were open.
//
// A filter alone is not enough, because rails and walls seem to move: their visible part moves with
// the car. The grid, however, stores the previous state of each place.
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
};

// Counts good, bad and neutral places in track.seen. The track and its hits are compared with the
// youngest snapshot that is old enough to show motion. For a receding track, the trail is also
// updated.
void weigh_motion(std::uint64_t now_us, Point car, Velocity car_velocity,
                  std::span<const std::uint16_t> numbers, const Hits& hits, const GridNames& grid,
                  Track& track);

// Whether enough places confirm the motion.
[[nodiscard]] bool is_shown(const Seen& seen);

// Takes a snapshot of the track if one is due.
void remember(std::uint64_t now_us, std::span<const std::uint16_t> numbers,
              std::span<const FrameHit> hits, Track& track);

}  // namespace iog::objects
