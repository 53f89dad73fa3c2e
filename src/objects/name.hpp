// What the grid calls a cell, as far as it matters here.
#pragma once

#include <cstdint>

#include "decision/decision.hpp"

namespace iog::objects {

enum class Name : std::uint8_t { kUnknown, kFree, kMoving, kStanding, kOccupied };

[[nodiscard]] constexpr Name name_of(decision::Class its) {
  using decision::Class;
  switch (its) {
    case Class::kUnknown:
      break;
    case Class::kDrivable:
    case Class::kNonDrivable:
    case Class::kFree:
      return Name::kFree;
    case Class::kMoving:
      return Name::kMoving;
    case Class::kStopped:
    case Class::kStoppedOrUnmapped:
    case Class::kInfrastructure:
      return Name::kStanding;
    case Class::kOccupied:
      return Name::kOccupied;
  }
  return Name::kUnknown;
}

}  // namespace iog::objects
