// Merges tracks of the same object.
#pragma once

#include <span>

#include "objects/hit.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Two tracks are merged if they are close, have similar speeds and together are not too large for
// one object. The older track remains, with the hits of both.
void merge(std::span<Track> tracks, std::span<FrameHit> hits);

}  // namespace iog::objects
