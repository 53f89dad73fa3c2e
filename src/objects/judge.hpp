// Updates the state of a track or ends the track.
#pragma once

#include <cstdint>

#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Performs the first part of the update, which does not need the grid. A track ends if it has been
// unseen for too long, is longer than any object, or is both moving and too wide. A moving track
// without a trail stops if, for some time, most hits in its box have been classified as standing.
// Returns false if judge() need not be called in this frame.
[[nodiscard]] bool is_judged(std::uint64_t now_us, Step step, Track& track);

// Performs the rest of the update, after the grid has been queried.
void judge(std::uint64_t now_us, Track& track);

}  // namespace iog::objects
