// Whether the grid confirms the motion of a track: places that it has left are free now, and places
// that it has reached were open.
//
// A filter alone is not enough. Rails and walls seem to move, because their visible part travels
// with the car. The grid knows what was there before.
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

// Counts good, bad and neutral places into track.seen. Compares the track and its hits with the
// youngest snapshot that is old enough to show motion. For a receding track, also updates the
// trail.
void weigh_motion(std::uint64_t now_us, Point car, Velocity car_velocity,
                  std::span<const std::uint16_t> numbers, const Hits& hits, const GridNames& grid,
                  Track& track);

// Whether enough places support the motion.
[[nodiscard]] bool is_shown(const Seen& seen);

// Takes a snapshot of the track if one is due.
void remember(std::uint64_t now_us, std::span<const std::uint16_t> numbers,
              std::span<const FrameHit> hits, Track& track);

}  // namespace iog::objects
