// The box of a track turns towards its velocity, once that is sure.
#pragma once

#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// After a measurement. When the box turns for the first time it is taken anew from its hits. What
// has wheels does not slide: its speed across fades.
void turn(std::span<const std::uint16_t> numbers, std::span<const FrameHit> hits, Track& track);

}  // namespace iog::objects
