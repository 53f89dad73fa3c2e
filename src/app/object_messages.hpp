// Converts tracked objects to stream messages (docs/spec.md 3.12).
#pragma once

#include <cstdint>

#include "objects/track.hpp"
#include "objects/tracker.hpp"
#include "stream/objects.hpp"

namespace iog::app {

// Tracks with fewer updates than this are not sent because they are still uncertain.
inline constexpr std::uint32_t kToldFrom = 4;  // updates

// Returns the record of an existing track. `now_us` is the time of the track's position.
[[nodiscard]] stream::ObjectRecord record_of(const objects::Track& track, std::uint64_t now_us,
                                             objects::Point car);

// Lists the tracks to send, ordered by id. `time_us` is the time of all track positions. If time_us
// is 0, the list is empty. `counts` is the result of ObjectFollower::follow().
void list_objects(const objects::Tracks& tracks, std::uint64_t time_us,
                  const objects::FrameCounts& counts, objects::Point car, stream::ObjectList& list);

}  // namespace iog::app
