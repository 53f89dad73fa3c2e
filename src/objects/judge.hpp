// Updates the state of a track: determines whether it is moving, stationary, stopped or ended.
#pragma once

#include <cstdint>

#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// The first step, before the grid is queried. A track ends if it has not been seen for too long, if
// it is too long for any object, or if it is moving and too wide. A track has stopped if most hits
// in its box have been classified as standing for a while. Returns false if the second step is not
// needed in this frame.
[[nodiscard]] bool is_judged(std::uint64_t now_us, Step step, Track& track);

// The second step, after the grid has been queried.
void judge(std::uint64_t now_us, Track& track);

}  // namespace iog::objects
