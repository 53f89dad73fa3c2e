// Whether the grid agrees that a track has moved: places that it has left are free now, and places
// that it has come to were open.
//
// A filter alone believes that rails and walls move, because the part of them that is seen goes
// along with the car. The grid has seen what was there before.
#pragma once

#include <cstdint>
#include <span>

#include "objects/frame_hits.hpp"
#include "objects/grid_names.hpp"
#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Counts into track.seen the places of the youngest snapshot from which it is far enough away, and
// those of its hits; of what recedes whether it leaves a trail.
void weigh_motion(std::uint64_t now_us, Point car, Velocity car_velocity,
                  std::span<const std::uint16_t> numbers, const FrameHits& hits,
                  const GridNames& grid, Track& track);

// Whether enough of them say so.
[[nodiscard]] bool is_shown(const Seen& seen);

// Remembers where the track is, if it is time to.
void remember(std::uint64_t now_us, std::span<const std::uint16_t> numbers,
              std::span<const FrameHit> hits, Track& track);

}  // namespace iog::objects
