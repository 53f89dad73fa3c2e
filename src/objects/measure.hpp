// What a frame's hits say of the place, the speed and the box of a track.
#pragma once

#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Counts the track's own hits and measures it, if one of them does not stand; else they are
// nobody's, unless it is small. step: the frame's.
void measure(Point car, std::uint64_t now_us, Step step, std::span<const std::uint16_t> numbers,
             std::span<FrameHit> hits, Track& track);

}  // namespace iog::objects
