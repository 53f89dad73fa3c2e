// Maps the classes of grid cells to the few classes that tracking needs.
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

// The set of class labels of several cells. Bit i is set if any of the cells has class i.
class Names {
 public:
  constexpr Names() = default;
  explicit constexpr Names(std::uint32_t classes) : classes_(classes) {}

  template <Name kName>
  [[nodiscard]] constexpr bool has() const {
    constexpr std::uint32_t kAsked = classes_of(kName);
    return (classes_ & kAsked) != 0;
  }

 private:
  static constexpr std::uint32_t kClassCount = 9;

  static constexpr std::uint32_t classes_of(Name name) {
    std::uint32_t classes = 0;
    for (std::uint32_t i = 0; i < kClassCount; ++i) {
      classes |= name_of(static_cast<decision::Class>(i)) == name ? std::uint32_t{1} << i : 0;
    }
    return classes;
  }

  std::uint32_t classes_ = 0;
};

}  // namespace iog::objects
