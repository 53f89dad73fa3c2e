#include "fakes/test_vehicles.hpp"

#include "vehicle/compile.hpp"

namespace iog::tests {

// The sensors of a vehicle have a place of their own: a vehicle refers to them.
template <const auto& kConfigs, const vehicle::Description& kDescription>
constexpr auto kSensors = vehicle::compile_sensors(kConfigs, kDescription);

template <const auto& kConfigs, const vehicle::Description& kDescription>
consteval vehicle::Vehicle compiled() {
  return vehicle::compile_vehicle(kDescription, kSensors<kConfigs, kDescription>);
}

constexpr vehicle::Vehicle OneLux::kVehicle = compiled<OneLux::kConfigs, OneLux::kDescription>();
constexpr vehicle::Vehicle LevelLux::kVehicle =
    compiled<LevelLux::kConfigs, OneLux::kDescription>();
constexpr vehicle::Vehicle MidCellLux::kVehicle =
    compiled<MidCellLux::kConfigs, OneLux::kDescription>();
constexpr vehicle::Vehicle OneLuxNearest::kVehicle =
    compiled<OneLux::kConfigs, OneLuxNearest::kDescription>();
constexpr vehicle::Vehicle TiltedLux::kVehicle =
    compiled<TiltedLux::kConfigs, TiltedLux::kDescription>();
constexpr vehicle::Vehicle ThreeLux::kVehicle =
    compiled<ThreeLux::kConfigs, ThreeLux::kDescription>();

}  // namespace iog::tests
