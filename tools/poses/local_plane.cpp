#include "tools/poses/local_plane.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/elementary.hpp"
#include "tools/poses/pose_sample.hpp"

namespace iog::tools {
namespace {

// NIMA TR8350.2: the ellipsoid of WGS 84.
constexpr double kSemiMajorM = 6'378'137.0;
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kEccentricitySquared = kFlattening * (2 - kFlattening);

}  // namespace

LocalPlane::LocalPlane(double latitude, double longitude)
    : touches_{latitude, longitude},
      origin_(earth_of(latitude, longitude)),
      sin_latitude_(numeric::sin(latitude * kRadians)),
      cos_latitude_(numeric::cos(latitude * kRadians)),
      sin_longitude_(numeric::sin(longitude * kRadians)),
      cos_longitude_(numeric::cos(longitude * kRadians)) {}

LocalPlane::Earth LocalPlane::earth_of(double latitude, double longitude) {
  const double sin = numeric::sin(latitude * kRadians);
  const double cos = numeric::cos(latitude * kRadians);
  const double normal = kSemiMajorM / std::sqrt(1 - kEccentricitySquared * sin * sin);
  return {normal * cos * numeric::cos(longitude * kRadians),
          normal * cos * numeric::sin(longitude * kRadians),
          normal * (1 - kEccentricitySquared) * sin};
}

LocalPlane::Place LocalPlane::place_of(double latitude, double longitude) const {
  const Earth at = earth_of(latitude, longitude);
  const double x = at.x - origin_.x;
  const double y = at.y - origin_.y;
  const double z = at.z - origin_.z;
  const double outwards = x * cos_longitude_ + y * sin_longitude_;
  return {y * cos_longitude_ - x * sin_longitude_, z * cos_latitude_ - outwards * sin_latitude_};
}

// Newton's steps with the radii of curvature at the origin: each leaves less than a fiftieth of the
// error within 100 km.
Geodetic LocalPlane::geodetic_of(const Place& place) const {
  const double flattened = 1 - kEccentricitySquared * sin_latitude_ * sin_latitude_;
  const double normal = kSemiMajorM / std::sqrt(flattened);
  const double meridian = normal * (1 - kEccentricitySquared) / flattened;
  Geodetic at = touches_;
  for (int i = 0; i < 10; ++i) {
    const Place reached = place_of(at.latitude, at.longitude);
    at.latitude += (place.north_m - reached.north_m) / meridian / kRadians;
    at.longitude += (place.east_m - reached.east_m) / (normal * cos_latitude_) / kRadians;
  }
  return at;
}

double LocalPlane::metres_to(const LocalPlane& other) const {
  constexpr double kMeanRadiusM = 6'371'009;
  const Earth& from = origin_;
  const Earth& to = other.origin_;
  const double chord_m = std::hypot(to.x - from.x, to.y - from.y, to.z - from.z);
  return 2 * kMeanRadiusM * std::asin(std::min(1.0, chord_m / (2 * kMeanRadiusM)));
}

LocalPlane::Frame LocalPlane::frame_of(const LocalPlane& other) const {
  const double sin = other.sin_longitude_ * cos_longitude_ - other.cos_longitude_ * sin_longitude_;
  const double cos = other.cos_longitude_ * cos_longitude_ + other.sin_longitude_ * sin_longitude_;
  return {place_of(other.touches_.latitude, other.touches_.longitude),
          std::atan2(sin * sin_latitude_, cos)};
}

}  // namespace iog::tools
