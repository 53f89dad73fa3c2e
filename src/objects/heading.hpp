// Turns the box of a track towards its velocity if the velocity is certain enough.
#pragma once

#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Call turn() after a measurement. The first call rebuilds the box from the hits. The lateral speed
// of the box is reduced, because wheels do not slide sideways.
void turn(std::span<const std::uint16_t> numbers, std::span<const FrameHit> hits, Track& track);

}  // namespace iog::objects
