#include "fakes/test_vehicles.hpp"

#include <deque>

#include "fakes/compiled_car.hpp"
#include "require/require.hpp"
#include "tools/car/limits.hpp"

namespace iog::tests {
namespace {

// Also of a car that no file could describe: beside its grid, without a port. Its sensors live as
// long as the program.
vehicle::Vehicle tables_of(std::span<const description::SensorConfig> configs,
                           const description::Description& car) {
  static std::deque<CompiledCar> all;
  return all.emplace_back(configs, car).vehicle;
}

// What check() allows.
vehicle::Vehicle compiled(std::span<const description::SensorConfig> configs,
                          const description::Description& car) {
  auto refuse = [](const vehicle::Fault& /*fault*/) { require(false); };
  description::check(car, configs, vehicle::Tell(refuse));
  return tables_of(configs, car);
}

}  // namespace

const vehicle::Vehicle OneLux::kVehicle = compiled(OneLux::kConfigs, OneLux::kDescription);
const vehicle::Vehicle LevelLux::kVehicle = compiled(LevelLux::kConfigs, OneLux::kDescription);
const vehicle::Vehicle BumperLux::kVehicle = compiled(BumperLux::kConfigs, BumperLux::kDescription);
const vehicle::Vehicle MidCellLux::kVehicle = compiled(MidCellLux::kConfigs, OneLux::kDescription);
const vehicle::Vehicle OneLuxNearest::kVehicle =
    compiled(OneLux::kConfigs, OneLuxNearest::kDescription);
const vehicle::Vehicle TiltedLux::kVehicle = compiled(TiltedLux::kConfigs, TiltedLux::kDescription);
const vehicle::Vehicle ThreeLux::kVehicle = compiled(ThreeLux::kConfigs, ThreeLux::kDescription);
const vehicle::Vehicle LevelVlp16::kVehicle =
    compiled(LevelVlp16::kConfigs, LevelVlp16::kDescription);
const vehicle::Vehicle MixedCar::kVehicle = compiled(MixedCar::kConfigs, MixedCar::kDescription);
const vehicle::Vehicle RadarCar::kVehicle = compiled(RadarCar::kConfigs, RadarCar::kDescription);
const vehicle::Vehicle BayesRadarCar::kVehicle =
    compiled(RadarCar::kConfigs, BayesRadarCar::kDescription);
const vehicle::Vehicle RadarBus::kVehicle = compiled(RadarBus::kConfigs, RadarBus::kDescription);
const vehicle::Vehicle UltrasonicCar::kVehicle =
    compiled(UltrasonicCar::kConfigs, UltrasonicCar::kDescription);
const vehicle::Vehicle HighAndFar::kVehicle =
    compiled(HighAndFar::kConfigs, HighAndFar::kDescription);
const vehicle::Vehicle SteepVlp16::kVehicle =
    compiled(SteepVlp16::kConfigs, SteepVlp16::kDescription);
// No format has so many layers, which check() would say.
const vehicle::Vehicle ManyLayers::kVehicle =
    tables_of(ManyLayers::kConfigs, ManyLayers::kDescription);

}  // namespace iog::tests
