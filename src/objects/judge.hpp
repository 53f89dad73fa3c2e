// Whether a track moves, stands, has stopped, or is not there any more.
#pragma once

#include <cstdint>

#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Before the grid is asked: a track that nothing was seen of for long ends, and so does one that is
// too long for a thing, or too wide for one that moves; one whose box holds what has stood for long
// has stopped. False: there is nothing to judge in this frame.
[[nodiscard]] bool is_judged(std::uint64_t now_us, Step step, Track& track);

// After the grid was asked.
void judge(std::uint64_t now_us, Track& track);

}  // namespace iog::objects
