// Tracks that are of one thing become one.
#pragma once

#include <span>

#include "objects/hit.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Of two that lie beside each other, are as fast, and together are not larger than a thing, the one
// that was born first stays, with the hits of both.
void merge(std::span<Track> tracks, std::span<FrameHit> hits);

}  // namespace iog::objects
