// Limits of poses: valid values, how long a pose is used, and when it is rejected (docs/spec.md,
// section 5).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::pose {

// Angles are converted to lengths at this distance, the range of the sensors.
inline constexpr std::int32_t kReachMm = 50'000;

// Valid values of a message. The widths of all arithmetic on poses follow from these bounds.
inline constexpr std::int32_t kMaxCoordinateMm = 1'000'000'000;
inline constexpr std::int32_t kMaxSpeedMmPerS = 100'000;
inline constexpr std::int32_t kMaxYawRateUradPerS = 10'000'000;
inline constexpr std::uint32_t kMaxAgeUs = 200'000;
// 146,000 years, so sums and differences of clocks and of the target's time do not wrap.
inline constexpr std::uint64_t kMaxClockUs = (std::uint64_t{1} << 62) - 1;

// Largest time between a slice and a message, and largest prediction beyond a message.
inline constexpr std::uint64_t kLateUs = 100'000;
// A silence as long as this breaks the history.
inline constexpr std::uint64_t kLostUs = 1'000'000;
// A clock has leapt if it is ahead of the target's clock by this much more than before.
inline constexpr std::uint64_t kMaxLeapUs = 2 * kLostUs;
// Messages of one run must be at least this far apart by their own clock; closer ones are dropped.
inline constexpr std::uint64_t kMinSpacingUs = 8'000;
// This many messages always cover more than the required second.
inline constexpr std::size_t kHistoryMessages = 128;
static_assert((kHistoryMessages - 1) * kMinSpacingUs >= kLostUs);

// Another run, or another clock, is accepted after this many of its messages in a row.
inline constexpr std::size_t kConfirmations = 3;

// Slices are not registered with a pose less certain than this: 150 mm, or as much at kReachMm.
inline constexpr std::uint16_t kMaxSigmaMm = 150;
inline constexpr std::uint16_t kMaxSigmaHeading = kMaxSigmaMm * 100'000 / kReachMm;  // 10 urad

// After a contradiction by the sensors, the source is rejected for this time, or until it has moved
// by a jump.
inline constexpr std::uint64_t kMaxStuckUs = 10'000'000;

// No clock drifts faster than kMaxDriftPpm. If the clock offset grows by more than
// kMaxDelayGrowthUs beyond this drift, the delay is growing.
inline constexpr std::uint64_t kMaxDriftPpm = 200;
inline constexpr std::int64_t kMaxDelayGrowthUs = 30'000;
// The source is accepted again after this time without such growth: twice the span of the least
// offset.
inline constexpr std::uint64_t kSettledUs = 2 * kLostUs;

// Larger residuals are a jump: 300 mm, or as much at kReachMm.
inline constexpr std::int64_t kMaxResidualMm = 300;
inline constexpr std::int64_t kAnglePerRadian = 683'565'276;  // 2^32 / (2 pi), to the nearest
inline constexpr std::int64_t kMaxResidualAngle = kAnglePerRadian * kMaxResidualMm / kReachMm;

}  // namespace iog::pose
