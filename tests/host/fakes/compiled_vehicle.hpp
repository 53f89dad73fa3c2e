// Computes the tables of a vehicle for tests from its description.
#pragma once

#include "vehicle/compile.hpp"

namespace iog::tests {

// The sensors of a vehicle have a place of their own: a vehicle refers to them.
template <const auto& kConfigs, const vehicle::Description& kDescription>
constexpr auto kSensors = vehicle::compile_sensors(kConfigs, kDescription);

template <const auto& kConfigs, const vehicle::Description& kDescription>
consteval vehicle::Vehicle compiled() {
  return vehicle::compile_vehicle(kDescription, kSensors<kConfigs, kDescription>);
}

}  // namespace iog::tests
