// Numbers of a frame's end in words.
//
// The limit of an i.MX6Q depends on its grade: 95 degrees at the junction for commercial ones, the
// lowest (NXP's data sheets IMX6DQCEC, IMX6DQIEC and IMX6DQAEC). Linux warns ten degrees below;
// that also covers a thermometer that is off by a few.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace iog::tools {

inline constexpr std::int16_t kWarmDc = 850;
inline constexpr std::int16_t kTooHotDc = 950;

// After "N % of ... ".
inline constexpr std::string_view kLostByJumps =
    "lost by jumps: within a second, the motion between poses differs from their speeds and yaw "
    "rates by more than 300 mm or 6 mrad. Check units, signs (headings count counter-clockwise "
    "from x) and noise; `iog odometry` makes smooth poses";
// As a user has to see them; fewer are usual.
inline constexpr std::uint64_t kOfManyLost = 20;

// "61.2 degrees Celsius", of the target's chip.
[[nodiscard]] std::string words_of_temperature(std::int16_t dc);

// Sectors around the vehicle that no sensor watches, or that are blocked (docs/spec.md 3.5): "90 to
// 129, -129 to -90 degrees", counter-clockwise from straight ahead; "none", or "all around".
[[nodiscard]] std::string words_of_sectors(std::uint64_t sectors);

}  // namespace iog::tools
