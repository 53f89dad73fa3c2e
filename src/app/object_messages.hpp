// Tracked objects as stream messages (docs/spec.md 3.12).
#pragma once

#include <cstdint>

#include "objects/track.hpp"
#include "objects/tracker.hpp"
#include "stream/objects.hpp"

namespace iog::app {

// Younger tracks are not sent, because it is not yet certain what they are.
inline constexpr std::uint32_t kToldFrom = 4;  // updates

// Returns the record of an existing track. now_us is the time to which the track's position refers.
[[nodiscard]] stream::ObjectRecord record_of(const objects::Track& track, std::uint64_t now_us,
                                             objects::Point car);

// Lists the tracks that are sent, ordered by id. time_us is the time to which their positions
// refer. If it is 0, there are no tracks. `counts` is the result of ObjectFollower::follow().
void list_objects(const objects::Tracks& tracks, std::uint64_t time_us,
                  const objects::FrameCounts& counts, objects::Point car, stream::ObjectList& list);

}  // namespace iog::app
