// What a pose may be, how far it carries, and when it is not believed (docs/spec.md, section 5).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::pose {

// What an angle is worth is asked at this distance, as far as the sensors see.
inline constexpr std::int32_t kReachMm = 50'000;

// What a message may say. The widths of all arithmetic on poses follow from these bounds.
inline constexpr std::int32_t kMaxCoordinateMm = 1'000'000'000;
inline constexpr std::int32_t kMaxSpeedMmPerS = 100'000;
inline constexpr std::int32_t kMaxYawRateUradPerS = 10'000'000;
inline constexpr std::uint32_t kMaxAgeUs = 200'000;
// 146,000 years: sums and differences of clocks and of the target's time do not wrap.
inline constexpr std::uint64_t kMaxClockUs = (std::uint64_t{1} << 62) - 1;

// How close in time a slice must be to a message, and how far a message is moved ahead.
inline constexpr std::uint64_t kLateUs = 100'000;
// A silence as long as this breaks the history.
inline constexpr std::uint64_t kLostUs = 1'000'000;
// A clock that is so much ahead of what it was by the target's has leapt.
inline constexpr std::uint64_t kMaxLeapUs = 2 * kLostUs;
// Messages of one run are at least this far apart, by their own clock; closer ones are dropped.
inline constexpr std::uint64_t kMinSpacingUs = 8'000;
// So many messages cover more than the second that is asked of them.
inline constexpr std::size_t kHistoryMessages = 128;
static_assert((kHistoryMessages - 1) * kMinSpacingUs >= kLostUs);

// Another run, or another clock, is believed when so many of its messages have come in a row.
inline constexpr std::size_t kConfirmations = 3;

// A pose less certain than this places nothing: 150 mm, or as much at kReachMm.
inline constexpr std::uint16_t kMaxSigmaMm = 150;
inline constexpr std::uint16_t kMaxSigmaHeading = kMaxSigmaMm * 100'000 / kReachMm;  // 10 urad

// A source that the sensors contradicted is not believed before so long, or a way that would be a
// jump.
inline constexpr std::uint64_t kMaxStuckUs = 10'000'000;

// No clock drifts faster. A clock offset that has grown by more than kMaxDelayGrowthUs beyond this
// is a growing delay.
inline constexpr std::uint64_t kMaxDriftPpm = 200;
inline constexpr std::int64_t kMaxDelayGrowthUs = 30'000;
// The source is believed again after so long without such growth: twice the span of the least
// offset.
inline constexpr std::uint64_t kSettledUs = 2 * kLostUs;

// Residuals above this are a jump: 300 mm, or as much at kReachMm.
inline constexpr std::int64_t kMaxResidualMm = 300;
inline constexpr std::int64_t kAnglePerRadian = 683'565'276;  // 2^32 / (2 pi), to the nearest
inline constexpr std::int64_t kMaxResidualAngle = kAnglePerRadian * kMaxResidualMm / kReachMm;

}  // namespace iog::pose
