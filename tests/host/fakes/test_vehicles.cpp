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

constexpr vehicle::Vehicle LevelVlp16::kVehicle =
    compiled<LevelVlp16::kConfigs, LevelVlp16::kDescription>();
constexpr vehicle::Vehicle MixedCar::kVehicle =
    compiled<MixedCar::kConfigs, MixedCar::kDescription>();

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
