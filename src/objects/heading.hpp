// Turns the box of a track towards its velocity once that is certain enough.
#pragma once

#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Call after a measurement. The first turn rebuilds the box from the hits. The speed across the box
// fades, because wheels do not slide.
void turn(std::span<const std::uint16_t> numbers, std::span<const FrameHit> hits, Track& track);

}  // namespace iog::objects
