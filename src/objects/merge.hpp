// Merges tracks that belong to the same object.
#pragma once

#include <span>

#include "objects/hit.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Merges two tracks if they are close together and have similar speeds, unless the merged track
// would be too large for one object. The older track is kept and gets the hits of both tracks.
void merge(std::span<Track> tracks, std::span<FrameHit> hits);

}  // namespace iog::objects
