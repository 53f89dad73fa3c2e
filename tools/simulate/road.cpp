#include "tools/simulate/road.hpp"

#include <algorithm>
#include <cstddef>

#include "numeric/elementary.hpp"

namespace iog::tools {
namespace {

constexpr double kStep = 0.5;

}  // namespace

double Course::heading_at(double station) const {
  const double turn = 2 * numeric::kPi;
  double heading = radians_per_metre * station;
  for (const Swing& swing : swings) {
    heading += swing.radians * numeric::sin(turn * station / swing.wavelength);
  }
  return heading;
}

std::vector<double> stations(double first_m, double end_m, double step_m) {
  std::vector<double> stations;
  for (int i = 0; first_m + i * step_m < end_m; ++i) {
    stations.push_back(first_m + i * step_m);
  }
  return stations;
}

Road::Road(const Course& course, double first_m, double last_m) : course_(course), first_(first_m) {
  Point point{0, 0};
  for (const double station : stations(first_m, last_m + 2 * kStep, kStep)) {
    points_.push_back(point);
    const double heading = course_.heading_at(station + kStep / 2);
    point.x += kStep * numeric::cos(heading);
    point.y += kStep * numeric::sin(heading);
  }
}

Placement Road::at(double station, double left) const {
  const double position = std::max(0.0, (station - first_) / kStep);
  const std::size_t before = std::min(static_cast<std::size_t>(position), points_.size() - 2);
  const double share = position - static_cast<double>(before);
  const Point& a = points_[before];
  const Point& b = points_[before + 1];
  const double heading = course_.heading_at(station);
  const Placement centre{.x = a.x + (b.x - a.x) * share,
                         .y = a.y + (b.y - a.y) * share,
                         .cos = numeric::cos(heading),
                         .sin = numeric::sin(heading)};
  return moved(centre, 0, left);
}

Placement turned_by(const Placement& placement, double cos, double sin) {
  return {.x = placement.x,
          .y = placement.y,
          .cos = placement.cos * cos - placement.sin * sin,
          .sin = placement.sin * cos + placement.cos * sin};
}

Placement moved(const Placement& placement, double forward, double left) {
  return {.x = placement.x + forward * placement.cos - left * placement.sin,
          .y = placement.y + forward * placement.sin + left * placement.cos,
          .cos = placement.cos,
          .sin = placement.sin};
}

}  // namespace iog::tools
