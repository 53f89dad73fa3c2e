// Updates the position, speed and box of a track from the hits of a frame.
#pragma once

#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Counts the hits of the track. If at least one hit is not standing, updates the track with a
// measurement. If all hits are standing and the track is not small, the hits lose their owner.
// `step` is the time since the previous frame.
void measure(Point car, std::uint64_t now_us, Step step, std::span<const std::uint16_t> numbers,
             std::span<FrameHit> hits, Track& track);

}  // namespace iog::objects
