// What a stream's numbers are called, for a person: as the table of the target's counters has it.
#pragma once

#include <array>
#include <string_view>

#include "stream/target_state.hpp"

namespace iog::tools {

inline constexpr auto kPointFateNames = stream::names_of<stream::Group::kFate>();
inline constexpr auto kPacketDropNames = stream::names_of<stream::Group::kPacketDrop>();
inline constexpr auto kSensorStateNames = stream::names_of<stream::Group::kSensorState>();
inline constexpr auto kPoseFateNames = stream::names_of<stream::Group::kPoseFate>();
inline constexpr auto kPoseCauseNames = stream::names_of<stream::Group::kSliceCause>();
inline constexpr auto kMapCauseNames = stream::names_of<stream::Group::kMapCause>();
inline constexpr auto kChunkNames = stream::names_of<stream::Group::kChunkFate>();
inline constexpr auto kLoopTimeNames = stream::names_of<stream::Group::kLoopTime>();
// Behind a sensor's state: where nearly nothing comes back.
inline constexpr std::array<std::string_view, 3> kBlockedNames{"", ", partly blocked", ", blocked"};

}  // namespace iog::tools
