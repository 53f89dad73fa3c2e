#include "tools/simulate/world/road.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numeric/elementary.hpp"
#include "require/require.hpp"

namespace iog::tools {

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
    const double heading = course.heading_at(station + kStep / 2);
    point.x += kStep * numeric::cos(heading);
    point.y += kStep * numeric::sin(heading);
  }
}

Road::Road(std::vector<Point> points, std::size_t zero)
    : first_(-kStep * static_cast<double>(zero)), points_(std::move(points)) {
  require(points_.size() >= 4);
}

Placement Road::heading_at(double station, std::size_t before, double share) const {
  if (course_) {
    const double heading = course_->heading_at(station);
    return {.cos = numeric::cos(heading), .sin = numeric::sin(heading)};
  }
  const std::size_t inner = std::clamp<std::size_t>(before, 1, points_.size() - 3);
  const Point& a = points_[inner - 1];
  const Point& b = points_[inner];
  const Point& c = points_[inner + 1];
  const Point& d = points_[inner + 2];
  const double x = (c.x - a.x) * (1 - share) + (d.x - b.x) * share;
  const double y = (c.y - a.y) * (1 - share) + (d.y - b.y) * share;
  const double norm = std::sqrt(x * x + y * y);
  return {.cos = x / norm, .sin = y / norm};
}

Placement Road::at(double station, double left) const {
  const double position = std::max(0.0, (station - first_) / kStep);
  const std::size_t before = std::min(static_cast<std::size_t>(position), points_.size() - 2);
  const double share = position - static_cast<double>(before);
  const Point& a = points_[before];
  const Point& b = points_[before + 1];
  Placement centre = heading_at(station, before, std::min(share, 1.0));
  centre.x = a.x + (b.x - a.x) * share;
  centre.y = a.y + (b.y - a.y) * share;
  return moved(centre, 0, left);
}

Road::Place Road::nearest(double x, double y, double station) const {
  constexpr double kExact = 1e-7;
  constexpr int kMostSteps = 20;
  Place place{station, 0};
  for (int i = 0; i < kMostSteps; ++i) {
    const Placement there = at(place.station, 0);
    const Placement beyond = at(place.station + 1, 0);
    const double along = (x - there.x) * there.cos + (y - there.y) * there.sin;
    place.left = (y - there.y) * there.cos - (x - there.x) * there.sin;
    // In a bend to the left a metre of the centre line is less on its left.
    const double bend = beyond.sin * there.cos - beyond.cos * there.sin;
    place.station += along / std::max(0.2, 1 - bend * place.left);
    if (std::abs(along) < kExact) {
      break;
    }
  }
  return place;
}

Road::Place Road::nearest(double x, double y) const {
  const auto far = [&](const Point& point) {
    return (point.x - x) * (point.x - x) + (point.y - y) * (point.y - y);
  };
  const auto closest = std::ranges::min_element(points_, {}, far);
  return nearest(x, y, first_ + kStep * static_cast<double>(closest - points_.begin()));
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
