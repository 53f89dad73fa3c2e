// What a cell of the perception grid is called, in double precision: masses and map to a class.
// Ignorance names nothing, and the map never overrules what was seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fakes/reference_cell.hpp"

namespace iog::tests {

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

struct ReferenceDecision {
  CellClass named = CellClass::kUnknown;
  int sureness = 0;   // 0 ... 7, in sixteenths above one half
  double margin = 1;  // how far from one half the nearest score was that had a say

  [[nodiscard]] std::int8_t byte() const {
    return static_cast<std::int8_t>(static_cast<int>(named) * 8 + sureness);
  }
};

// One half, as the integers have it.
inline constexpr double kHalf = 16'384.0 / evidence::kCertain;

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
  const auto reaches_half = [&](double score) {
    decision.margin = std::min(decision.margin, std::abs(score - kHalf));
    const double above = (score - kHalf) * evidence::kCertain / 2048;
    decision.sureness = static_cast<int>(std::clamp(std::floor(above), 0.0, 7.0));
    return score >= kHalf;
  };
  if (reaches_half(cell.free)) {
    decision.named = name_of_free(mask);
    return decision;
  }
  if (!reaches_half(cell.taken())) {
    return decision;
  }
  const int sureness = decision.sureness;
  // Occupied by what moves: half of what is undecided, in a building next to nothing.
  const double moving = cell.moving + cell.occupied * (mask == kBuilding ? 2 : 128) / 256;
  if (reaches_half(moving)) {
    decision.named = CellClass::kMoving;
  } else if (reaches_half(cell.taken() - moving)) {
    decision.named = name_of_static(mask);
  } else {
    decision.named = CellClass::kOccupied;
    decision.sureness = sureness;
  }
  return decision;
}

// What the rule for "moved" asks of a cell when it has been decided.
struct ReferenceBits {
  bool freed = false;
  bool seen = false;
  bool stands = false;
  bool taken = false;
};

// index: of this very frame; 0 where the cell was decided without evidence.
inline ReferenceBits reference_bits(const ReferenceCell& cell, int index) {
  const auto exceeds = [](double mass, int units) { return mass * evidence::kCertain > units; };
  return {.freed = exceeds(cell.free, 16'384),
          .seen = index < 0 && exceeds(cell.free, 22'938),
          .stands = exceeds(cell.persistence, 4096),
          .taken = exceeds(cell.taken(), 8192)};
}

}  // namespace iog::tests
