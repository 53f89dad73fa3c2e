// What counts in a frame of a perceived drive: things that move, and tracks that are said to.
//
// A mover is a car or a person within kCountsM of the car, faster than kCountsMps and hit by
// kCountsHits or more of the hits that the tracker has looked at. A hit is on what is within 0.2 m
// of its cell (lab/experiments/perception/truth.hpp).
//
// What is reported are tracks that move, were hit in the frame and lie within kCountsM. Something
// moves where such a track is if half as many of its hits as are on anything else are on what moves
// or has stopped less than a second ago.
#pragma once

#include <cstddef>

#include "lab/evaluation/object_scores.hpp"
#include "lab/experiments/perception/perceived_drive.hpp"
#include "lab/experiments/perception/truth.hpp"
#include "objects/tracker.hpp"

namespace iog::lab {

inline constexpr double kCountsM = 40;
inline constexpr double kCountsMps = 0.3;  // slower tracks are not said to move
inline constexpr std::size_t kCountsHits = 2;

// The frame has a slice that was placed, and the tracker is that of the same frame.
[[nodiscard]] ObjectFrame object_frame(const PerceivedFrame& frame, const FrameTruth& truth,
                                       const objects::Tracker& tracker);

}  // namespace iog::lab
