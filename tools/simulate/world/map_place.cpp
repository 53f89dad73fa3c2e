#include "tools/simulate/world/map_place.hpp"

#include "numeric/elementary.hpp"
#include "tools/simulate/world/road.hpp"

namespace iog::tools {
namespace {

Placement placement_of(const pose::Pose& pose) {
  const double heading = pose.heading / 0x1p32 * 2 * numeric::kPi;
  return {.x = pose.x_mm / 1000.0,
          .y = pose.y_mm / 1000.0,
          .cos = numeric::cos(heading),
          .sin = numeric::sin(heading)};
}

}  // namespace

ToMapPlane::ToMapPlane(const MapPlace& place) : frame_(placement_of(place.local_frame)) {}

LocalPlane::Place ToMapPlane::place_of(double x_m, double y_m) const {
  const Placement at = moved(frame_, x_m, y_m);
  return {at.x, at.y};
}

}  // namespace iog::tools
