// The vehicles for tests with one LUX.
#include "fakes/test_vehicles.hpp"

#include "fakes/compiled_vehicle.hpp"

namespace iog::tests {

constexpr vehicle::Vehicle OneLux::kVehicle = compiled<OneLux::kConfigs, OneLux::kDescription>();
constexpr vehicle::Vehicle LevelLux::kVehicle =
    compiled<LevelLux::kConfigs, OneLux::kDescription>();
constexpr vehicle::Vehicle MidCellLux::kVehicle =
    compiled<MidCellLux::kConfigs, OneLux::kDescription>();
constexpr vehicle::Vehicle OneLuxNearest::kVehicle =
    compiled<OneLux::kConfigs, OneLuxNearest::kDescription>();
constexpr vehicle::Vehicle TiltedLux::kVehicle =
    compiled<TiltedLux::kConfigs, TiltedLux::kDescription>();

}  // namespace iog::tests
