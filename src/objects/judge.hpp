// Updates the state of a track. A track can be moving, stationary, stopped or ended.
#pragma once

#include <cstdint>

#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Performs the first step, which does not need the grid. A track ends if it has been unseen for too
// long, if it is longer than any object, or if it is moving and too wide. A track has stopped if
// most hits in its box have been classified as standing for some time. Returns false if the second
// step is not needed in this frame.
[[nodiscard]] bool is_judged(std::uint64_t now_us, Step step, Track& track);

// Performs the second step, after the grid has been queried.
void judge(std::uint64_t now_us, Track& track);

}  // namespace iog::objects
