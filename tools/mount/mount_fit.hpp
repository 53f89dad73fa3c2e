// The mount of a unit by all of its turns, and how sure it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "tools/mount/motion_log.hpp"
#include "tools/mount/unit_turns.hpp"

namespace iog::tools {

// Of an HDL-64E on a real road this many know pitch to 0.015 degrees and height to 6 mm, 20 of them
// only to 0.08 degrees and 14 mm (docs/sensors.md).
inline constexpr std::size_t kFewestTurns = 50;
// Parts of a road say the same of a mount if they are apart.
inline constexpr std::size_t kParts = 3;
inline constexpr double kPartsApartS = 5;
// A mount does not change on the way. A road's crown leans the car, and so does a parking lot.
inline constexpr double kMostDifferenceDeg = 0.5;
inline constexpr double kMostDifferenceM = 0.1;

// A median of all turns, and those of three parts of the recording with as many turns each.
struct FittedValue {
  double value = 0;
  std::array<double, kParts> parts{};
  double scatter = 0;  // standard deviation of single turns

  [[nodiscard]] double difference() const;  // of the parts, at most
};

struct MountFit {
  std::array<std::uint64_t, kCarStateCount> turns{};  // that show the ground, by the car's motion
  std::size_t taken = 0;
  double apart_s = 0;  // from the middle of a part to the next, at least
  FittedValue pitch_deg;
  FittedValue roll_deg;
  FittedValue z_m;
  double residual_m = 0;
  // Why there is no mount; empty: there is one, and all but this and `turns` says what it is.
  std::string refusal;

  [[nodiscard]] bool has_roll() const { return roll_deg.difference() < kMostDifferenceDeg; }
};

// Also why a unit has no mount.
inline constexpr const char* kOtherWayUp = "is the other way up: its roll_deg differs by 180";

// mounts: of the turns that show the ground, of `turns` in all. Refused if they are too few.
[[nodiscard]] MountFit fit_of(std::span<const TurnMount> mounts, std::uint64_t turns,
                              const MotionLog& motion, std::size_t fewest = kFewestTurns);
// The capture is over. Also refused if the unit is the other way up.
[[nodiscard]] MountFit fit_of(const UnitTurns& unit, const MotionLog& motion,
                              std::size_t fewest = kFewestTurns);

}  // namespace iog::tools
