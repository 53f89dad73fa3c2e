#include "tools/vehicles/upward_mount.hpp"

#include <sstream>

namespace iog::tools {

std::string warning_of_upward_mounts(const CatalogueEntry& car) {
  constexpr double kLevelDeg = 5;
  std::ostringstream text;
  for (const description::SensorConfig& sensor : car.sensors) {
    if (sensor.mount.pitch_deg < -kLevelDeg) {
      text << "warning: " << car.vehicle->name << ": sensor " << sensor.name
           << ": pitch_deg = " << sensor.mount.pitch_deg << " looks up by "
           << -sensor.mount.pitch_deg << " degrees; one that looks down has a positive pitch_deg "
           << "(iog mount)\n";
    }
  }
  return text.str();
}

}  // namespace iog::tools
