// Defines the valid ranges of pose values, how long a pose is used, and when a pose is rejected
// (docs/spec.md, section 5).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::pose {

// Angles are converted to lengths at this distance, which equals the range of the sensors.
inline constexpr std::int32_t kReachMm = 50'000;

// The valid ranges of the values in a message. The integer widths of all computations with poses
// follow from these bounds.
inline constexpr std::int32_t kMaxCoordinateMm = 1'000'000'000;
inline constexpr std::int32_t kMaxSpeedMmPerS = 100'000;
inline constexpr std::int32_t kMaxYawRateUradPerS = 10'000'000;
inline constexpr std::uint32_t kMaxAgeUs = 200'000;
// The maximum clock value corresponds to 146,000 years. The limit ensures that sums and differences
// of clock values and of the target's time do not wrap around.
inline constexpr std::uint64_t kMaxClockUs = (std::uint64_t{1} << 62) - 1;

// The maximum time between a slice and a message. A pose is predicted for at most kLateUs after a
// message.
inline constexpr std::uint64_t kLateUs = 100'000;
// A gap of kLostUs without messages causes a break.
inline constexpr std::uint64_t kLostUs = 1'000'000;
// A clock is considered to have jumped if its lead over the target's clock has increased by
// kMaxLeapUs.
inline constexpr std::uint64_t kMaxLeapUs = 2 * kLostUs;
// Messages of one run must be at least kMinSpacingUs apart on the sender's clock. Messages that are
// closer together are dropped.
inline constexpr std::uint64_t kMinSpacingUs = 8'000;
// A history of kHistoryMessages messages always covers more than the required one second.
inline constexpr std::size_t kHistoryMessages = 128;
static_assert((kHistoryMessages - 1) * kMinSpacingUs >= kLostUs);

// A different run or clock is accepted after kConfirmations consecutive messages from it.
inline constexpr std::size_t kConfirmations = 3;

// If the standard deviation of a pose exceeds 150 mm, no slices are registered with it. For the
// heading, the limit is the angle that corresponds to 150 mm at kReachMm.
inline constexpr std::uint16_t kMaxSigmaMm = 150;
inline constexpr std::uint16_t kMaxSigmaHeading = kMaxSigmaMm * 100'000 / kReachMm;  // 10 urad

// After a contradiction by the sensors, the source is rejected until its pose has changed by more
// than the jump limits, but for at most kMaxStuckUs.
inline constexpr std::uint64_t kMaxStuckUs = 10'000'000;

// No clock drifts faster than kMaxDriftPpm. If the clock offset grows by more than
// kMaxDelayGrowthUs beyond this drift, the delay is considered to be growing.
inline constexpr std::uint64_t kMaxDriftPpm = 200;
inline constexpr std::int64_t kMaxDelayGrowthUs = 30'000;
// The source is accepted again if the delay has not grown for kSettledUs. This time is twice the
// time span over which the minimum offset is computed.
inline constexpr std::uint64_t kSettledUs = 2 * kLostUs;

// A residual larger than kMaxResidualMm counts as a jump. For the heading, the limit is the angle
// that corresponds to 300 mm at kReachMm.
inline constexpr std::int64_t kMaxResidualMm = 300;
inline constexpr std::int64_t kAnglePerRadian = 683'565'276;  // 2^32 / (2 pi), rounded
inline constexpr std::int64_t kMaxResidualAngle = kAnglePerRadian * kMaxResidualMm / kReachMm;

}  // namespace iog::pose
