// Defines the valid ranges of pose values, how long a pose is used, and when a pose is rejected
// (docs/spec.md, section 5).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::pose {

// Angles are converted to lengths at this distance, which equals the range of the sensors.
inline constexpr std::int32_t kReachMm = 50'000;

// The valid ranges of the values in a message. These bounds determine the integer widths of all
// computations with poses.
inline constexpr std::int32_t kMaxCoordinateMm = 1'000'000'000;
inline constexpr std::int32_t kMaxSpeedMmPerS = 100'000;
inline constexpr std::int32_t kMaxYawRateUradPerS = 10'000'000;
inline constexpr std::uint32_t kMaxAgeUs = 200'000;
// The maximum clock value corresponds to 146,000 years. The limit ensures that no sum or difference
// of clock values and target times wraps around.
inline constexpr std::uint64_t kMaxClockUs = (std::uint64_t{1} << 62) - 1;

// The maximum time between the middle of a slice and the nearest message. A pose is predicted for
// at most kLateUs after a message.
inline constexpr std::uint64_t kLateUs = 100'000;
// A gap of kLostUs without messages causes a break.
inline constexpr std::uint64_t kLostUs = 1'000'000;
// A clock has jumped if it gains more than kMaxLeapUs on the target's clock from one message to the
// next.
inline constexpr std::uint64_t kMaxLeapUs = 2 * kLostUs;
// Messages of one run must be at least kMinSpacingUs apart on the sender's clock. A message that
// follows sooner is dropped.
inline constexpr std::uint64_t kMinSpacingUs = 8'000;
// A history of kHistoryMessages messages always covers more than the required one second.
inline constexpr std::size_t kHistoryMessages = 128;
static_assert((kHistoryMessages - 1) * kMinSpacingUs >= kLostUs);

// A different run or clock is accepted after kConfirmations consecutive messages from it.
inline constexpr std::size_t kConfirmations = 3;

// A pose is not used to register slices if its standard deviation exceeds 150 mm. For the heading,
// the limit is the angle that corresponds to 150 mm at kReachMm.
inline constexpr std::uint16_t kMaxSigmaMm = 150;
inline constexpr std::uint16_t kMaxSigmaHeading = kMaxSigmaMm * 100'000 / kReachMm;  // 10 urad

// After a contradiction by the sensors, poses are rejected for kMaxStuckUs, or until one differs
// from the last pose before the contradiction by more than the jump limits.
inline constexpr std::uint64_t kMaxStuckUs = 10'000'000;

// No clock drifts faster than kMaxDriftPpm. If the clock offset grows by more than
// kMaxDelayGrowthUs beyond this drift, the delay is considered to be growing.
inline constexpr std::uint64_t kMaxDriftPpm = 200;
inline constexpr std::int64_t kMaxDelayGrowthUs = 30'000;
// The source is accepted again if the delay has not grown for kSettledUs. This is twice the period
// over which the minimum offset is computed.
inline constexpr std::uint64_t kSettledUs = 2 * kLostUs;

// A residual larger than kMaxResidualMm counts as a jump. For the heading, the limit is the angle
// that corresponds to 300 mm at kReachMm.
inline constexpr std::int64_t kMaxResidualMm = 300;
inline constexpr std::int64_t kAnglePerRadian = 683'565'276;  // 2^32 / (2 pi), rounded
inline constexpr std::int64_t kMaxResidualAngle = kAnglePerRadian * kMaxResidualMm / kReachMm;

}  // namespace iog::pose
