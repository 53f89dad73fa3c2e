// Updates the position, speed and box of a track from the hits of a frame.
#pragma once

#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Counts the hits of the track. If at least one hit is not standing, updates the position, speed
// and box of the track. Otherwise, if the track has a trail or is larger than a pedestrian, its
// hits are removed. Standing hits are also removed if the track is mostly standing. `step` is the
// time since the previous frame.
void measure(Point car, std::uint64_t now_us, Step step, std::span<const std::uint16_t> numbers,
             std::span<FrameHit> hits, Track& track);

}  // namespace iog::objects
