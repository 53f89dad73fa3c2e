// Decides whether a track moves, stands, has stopped or ends.
#pragma once

#include <cstdint>

#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// First step, before the grid is queried. A track ends if it was unseen for too long, is too long
// for any object, or moves and is too wide. It has stopped if its box has held mostly standing hits
// for a while. Returns false if there is nothing left to judge in this frame.
[[nodiscard]] bool is_judged(std::uint64_t now_us, Step step, Track& track);

// Second step, after the grid was queried.
void judge(std::uint64_t now_us, Track& track);

}  // namespace iog::objects
