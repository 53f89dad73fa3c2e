// Determines the class and the bits of one cell. This file specifies the result in plain integer
// arithmetic. `decision_neon.cpp` computes the same results for eight cells at once.
//
// The cell must be valid (evidence/cell.hpp), so F + P <= 32767, where P = O + M + K. At most one
// of F and P is therefore 2^14 or more. P consists of a moving part m, which is at most M + O, and
// a static part P - m. At most one of these two parts is therefore 2^14 or more. No sum exceeds
// 32767.
#pragma once

#include <array>
#include <cstdint>

#include "decision/decision.hpp"
#include "evidence/cell.hpp"

namespace iog::decision {

inline constexpr std::int32_t kHalf = 1 << 14;
inline constexpr int kLevelShift = 11;

// The thresholds for setting the bits that later frames use (decision/decision.hpp). The values are
// tuned to distinguish motion from flicker.
inline constexpr std::int32_t kFreedAbove = kHalf;
inline constexpr std::int32_t kSeenAbove = 22'938;
inline constexpr std::int32_t kStandsAbove = 4096;
inline constexpr std::int32_t kTakenAbove = 8192;

// A table indexed by a bit mask of the map classes that are possible in a cell. Mask 0 is treated
// like mask 7.
using ByMask = std::array<std::uint8_t, 8>;

consteval ByMask by_mask(Class other, Class building, Class road, Class beside_roads) {
  ByMask classes{};
  classes.fill(static_cast<std::uint8_t>(other));
  classes[kBuilding] = static_cast<std::uint8_t>(building);
  classes[kRoad] = static_cast<std::uint8_t>(road);
  classes[kIntermediate] = static_cast<std::uint8_t>(beside_roads);
  classes[kBuilding + kIntermediate] = static_cast<std::uint8_t>(beside_roads);
  return classes;
}

inline constexpr ByMask kFreeClasses =
    by_mask(Class::kFree, Class::kNonDrivable, Class::kDrivable, Class::kNonDrivable);
inline constexpr ByMask kStandingClasses = by_mask(
    Class::kStoppedOrUnmapped, Class::kInfrastructure, Class::kStopped, Class::kStoppedOrUnmapped);

// The fraction of O that is treated as moving, in units of 1/256. The fraction is almost zero
// inside a building, and one half elsewhere.
inline constexpr ByMask kMovingShares = {128, 2, 128, 128, 128, 128, 128, 128};

constexpr std::uint8_t mask_of(std::uint8_t ruled_out) {
  return static_cast<std::uint8_t>(kAnywhere & ~ruled_out);
}

struct Verdict {
  std::uint8_t name = static_cast<std::uint8_t>(Class::kUnknown);
  std::int32_t score = kHalf;
};

constexpr Verdict verdict(const evidence::Cell& cell, std::uint8_t mask) {
  const std::int32_t taken = cell.taken();
  const std::int32_t moving =
      cell.moving + evidence::product(cell.occupied, kMovingShares[mask] << 7);
  const std::int32_t standing = taken - moving;
  if (cell.free >= kHalf) {
    return {kFreeClasses[mask], cell.free};
  }
  if (taken < kHalf) {
    return {};
  }
  if (moving >= kHalf) {
    return {static_cast<std::uint8_t>(Class::kMoving), moving};
  }
  if (standing >= kHalf) {
    return {kStandingClasses[mask], standing};
  }
  return {static_cast<std::uint8_t>(Class::kOccupied), taken};
}

// Returns 8 times the class plus a confidence of 0 ... 7. The maximum score, 32767, results in a
// confidence of 7.
constexpr std::int8_t byte_of(const Verdict& verdict) {
  return static_cast<std::int8_t>(verdict.name * 8 + ((verdict.score - kHalf) >> kLevelShift));
}

}  // namespace iog::decision
