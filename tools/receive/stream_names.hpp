// What a stream's numbers are called, for a person (docs/spec.md 1.3, 1.4, 3.5, 5.2, 5.5).
#pragma once

#include <array>
#include <string_view>

#include "intake/sensor_report.hpp"
#include "pose/fate.hpp"
#include "pose/history.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {

inline constexpr std::array<std::string_view, vehicle::kFateCount> kPointFateNames{
    "used",    "no return",  "too near",        "too far", "height band",
    "flagged", "later echo", "malformed",       "stale",   "not taken",
    "ground",  "overhang",   "under the ground"};
inline constexpr std::array<std::string_view, intake::kPacketDropCount> kPacketDropNames{
    "stranger", "wrong length", "wrong type", "wrong angle", "wrong point", "duplicate",
    "late",     "over budget",  "other unit", "not taken",   "frozen",      "too soon"};
inline constexpr std::array<std::string_view, 4> kSensorStateNames{"never seen", "silent",
                                                                   "partial", "complete"};
// Behind the state: where nearly nothing comes back.
inline constexpr std::array<std::string_view, 3> kBlockedNames{"", ", partly blocked", ", blocked"};
inline constexpr std::array<std::string_view, pose::kCauseCount> kPoseCauseNames{
    "placed", "late", "imprecise", "lost", "jump", "restart", "contradicted", "drifting"};
inline constexpr std::array<std::string_view, pose::kFateCount> kPoseFateNames{
    "used",    "unconfirmed",  "stranger",    "too short",    "not ours",     "wrong version",
    "damaged", "wrong length", "wrong flags", "not zero",     "out of range", "no sigma",
    "too old", "not newer",    "flood",       "of a past run"};

}  // namespace iog::tools
