// What the names of the perception grid are worth: cells by what they are called and by what is
// true of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "tools/simulate/truth/cell_truth.hpp"
#include "tools/simulate/truth/true_ground.hpp"

namespace iog::lab {

// Of class bytes (docs/spec.md 3.9): 0 unknown, 1 drivable ... 8 occupied.
inline constexpr std::size_t kClassCount = 9;

enum class NameTruth : std::uint8_t {
  kRoad,     // free ground of a road: drivable
  kBeside,   // free ground beside
  kMoving,   // something that moves
  kStopped,  // a car or a person that stands
  kHouse,    // a house
  kOther,    // anything else that cannot move: poles, trees, rails, barriers, banks
};
inline constexpr std::size_t kNameTruthCount = 6;

[[nodiscard]] constexpr NameTruth name_truth(tools::TrueClass what, tools::Ground ground) {
  switch (what) {
    case tools::TrueClass::kMoving:
      return NameTruth::kMoving;
    case tools::TrueClass::kMovable:
      return NameTruth::kStopped;
    case tools::TrueClass::kInfrastructure:
      return ground == tools::Ground::kHouse ? NameTruth::kHouse : NameTruth::kOther;
    case tools::TrueClass::kFree:
      break;
  }
  // A house that ends above or below the height band is ground to stay off.
  return ground == tools::Ground::kRoad ? NameTruth::kRoad : NameTruth::kBeside;
}

// Counts by class and truth.
using Confusion = std::array<std::array<std::uint64_t, kNameTruthCount>, kClassCount>;

}  // namespace iog::lab
