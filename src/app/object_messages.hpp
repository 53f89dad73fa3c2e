// Things with a speed, as the stream says them (docs/spec.md 3.12).
#pragma once

#include <cstdint>

#include "objects/track.hpp"
#include "objects/tracker.hpp"
#include "stream/objects.hpp"

namespace iog::app {

// A younger thing may be anything.
inline constexpr std::uint32_t kToldFrom = 4;  // updates

// A track that is there. now_us: the time of its place.
[[nodiscard]] stream::ObjectRecord record_of(const objects::Track& track, std::uint64_t now_us,
                                             objects::Point car);

// Those of the tracks that are told, in the order of their ids. time_us: when they were where they
// are; none if it is 0. counts: of the frame.
void list_objects(const objects::Tracks& tracks, std::uint64_t time_us,
                  const objects::FrameCounts& counts, objects::Point car, stream::ObjectList& list);

}  // namespace iog::app
