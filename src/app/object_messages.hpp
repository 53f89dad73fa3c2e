// Things with a speed, as the stream says them (docs/spec.md 3.12).
#pragma once

#include <cstdint>

#include "app/perception_report.hpp"
#include "objects/track.hpp"
#include "stream/objects.hpp"

namespace iog::app {

// A younger thing may be anything.
inline constexpr std::uint32_t kToldFrom = 4;  // updates

// A track that is there. now_us: the time of its place.
[[nodiscard]] stream::ObjectRecord record_of(const objects::Track& track, std::uint64_t now_us,
                                             objects::Point car);

// Those of the frame's tracks that are told, in the order of their ids; none if the frame has no
// place.
void list_objects(const PerceptionReport& report, const objects::Tracks& tracks,
                  stream::ObjectList& list);

}  // namespace iog::app
