// What a cell of the perception grid is called, in double precision: masses and map to a class.
// Ignorance names nothing, and the map never overrules what was seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lab/reference/cell.hpp"

namespace iog::lab::reference {

enum class CellClass : std::int8_t {
  kUnknown,
  kDrivable,
  kNonDrivable,
  kFree,  // the map does not say which of the two
  kMoving,
  kStopped,
  kStoppedOrUnmapped,
  kInfrastructure,
  kOccupied,  // not known by what
};

// Classes of the map that are possible in a cell: a sum of these, 1 ... 7.
inline constexpr unsigned kBuilding = 1;
inline constexpr unsigned kRoad = 2;
inline constexpr unsigned kIntermediate = 4;
inline constexpr unsigned kMapSilent = 7;

// One half, as the integers have it, and a step of sureness; all of a mass is 32,767 there.
inline constexpr double kCertain = 32'767;
inline constexpr double kHalf = 16'384 / kCertain;
inline constexpr double kStep = 2048 / kCertain;

struct ReferenceDecision {
  CellClass named = CellClass::kUnknown;
  double score = 0;   // the mass that named it
  double margin = 1;  // how far from one half the nearest score was that had a say

  // 0 ... 7, in sixteenths above one half.
  [[nodiscard]] int sureness() const {
    return static_cast<int>(std::clamp(std::floor((score - kHalf) / kStep), 0.0, 7.0));
  }
  // How far the score is from where its sureness changes.
  [[nodiscard]] double margin_of_sureness() const {
    const double steps = (score - kHalf) / kStep;
    return std::abs(steps - std::clamp(std::round(steps), 1.0, 7.0)) * kStep;
  }
  [[nodiscard]] std::int8_t byte() const {
    return static_cast<std::int8_t>(static_cast<int>(named) * 8 + sureness());
  }
};

inline CellClass name_of_free(unsigned mask) {
  switch (mask) {
    case kRoad:
      return CellClass::kDrivable;
    case kBuilding:
    case kIntermediate:
    case kBuilding | kIntermediate:
      return CellClass::kNonDrivable;
    default:
      return CellClass::kFree;
  }
}

inline CellClass name_of_static(unsigned mask) {
  switch (mask) {
    case kRoad:
      return CellClass::kStopped;
    case kBuilding:
      return CellClass::kInfrastructure;
    default:
      return CellClass::kStoppedOrUnmapped;
  }
}

inline ReferenceDecision reference_decision(const ReferenceCell& cell, unsigned mask) {
  ReferenceDecision decision;
  const auto is_named_by = [&](double score, CellClass name) {
    decision.margin = std::min(decision.margin, std::abs(score - kHalf));
    if (score >= kHalf) {
      decision.named = name;
      decision.score = score;
    }
    return score >= kHalf;
  };
  if (is_named_by(cell.free, name_of_free(mask)) ||
      !is_named_by(cell.taken(), CellClass::kOccupied)) {
    return decision;
  }
  // Occupied by what moves: half of what is undecided, in a building next to nothing.
  const double moving = cell.moving + cell.occupied * (mask == kBuilding ? 2 : 128) / 256;
  if (!is_named_by(moving, CellClass::kMoving)) {
    is_named_by(cell.taken() - moving, name_of_static(mask));
  }
  return decision;
}

}  // namespace iog::lab::reference
