// The vehicles for tests with several sensors, or with one that turns. The tests of the grid at
// other resolutions do without them, and their tables take the compiler longest.
#include "fakes/compiled_vehicle.hpp"
#include "fakes/test_vehicles.hpp"

namespace iog::tests {

constexpr vehicle::Vehicle ThreeLux::kVehicle =
    compiled<ThreeLux::kConfigs, ThreeLux::kDescription>();
constexpr vehicle::Vehicle LevelVlp16::kVehicle =
    compiled<LevelVlp16::kConfigs, LevelVlp16::kDescription>();
constexpr vehicle::Vehicle MixedCar::kVehicle =
    compiled<MixedCar::kConfigs, MixedCar::kDescription>();
constexpr vehicle::Vehicle HighAndFar::kVehicle =
    compiled<HighAndFar::kConfigs, HighAndFar::kDescription>();

// No format has so many layers: those of the VLP-16 are compiled again.
constexpr std::array<vehicle::Sensor, 1> kManyLayers = [] {
  auto sensors = vehicle::compile_sensors(ManyLayers::kConfigs, ManyLayers::kDescription);
  vehicle::compile_detail::compile_layers(ManyLayers::kConfigs[0], ManyLayers::kElevationsDeg,
                                          sensors[0]);
  return sensors;
}();
constexpr vehicle::Vehicle ManyLayers::kVehicle =
    vehicle::compile_vehicle(ManyLayers::kDescription, kManyLayers);

}  // namespace iog::tests
