#include "tools/vehicles/unused_band.hpp"

#include <algorithm>
#include <sstream>

#include "tools/car/defaults.hpp"

namespace iog::tools {

std::string warning_of_unused_band(const CatalogueEntry& car) {
  const auto follows = [](const description::SensorConfig& sensor) {
    return sensor.ground.has_value();
  };
  if (!std::ranges::all_of(car.sensors, follows)) {
    return "";
  }
  const double z_min_m = car.description->z_min_m;
  const double z_max_m = car.description->z_max_m;
  double usual_m = 0;
  bool is_a_top = false;
  for (const description::SensorConfig& sensor : car.sensors) {
    usual_m = std::max(usual_m, description::top_m_over(sensor.mount.z_m));
    is_a_top = is_a_top || sensor.ground->top_m == z_max_m;
  }
  if (z_min_m == description::kUsualZMinM && (z_max_m == usual_m || is_a_top)) {
    return "";
  }
  const description::GroundConfig& ground = *car.sensors[0].ground;
  std::ostringstream text;
  text << "warning: " << car.vehicle->name << ": z_min_m = " << z_min_m
       << " and z_max_m = " << z_max_m
       << " have no effect, because each sensor follows the ground; "
       << "ground = { low_m = " << ground.low_m << ", top_m = " << ground.top_m << " } of sensor "
       << car.sensors[0].name << " says how high obstacles are\n";
  return text.str();
}

}  // namespace iog::tools
