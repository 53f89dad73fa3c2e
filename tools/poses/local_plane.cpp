#include "tools/poses/local_plane.hpp"

#include <cmath>

#include "tools/poses/pose_sample.hpp"

namespace iog::tools {
namespace {

// NIMA TR8350.2: the ellipsoid of WGS 84.
constexpr double kSemiMajorM = 6'378'137.0;
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kEccentricitySquared = kFlattening * (2 - kFlattening);

}  // namespace

LocalPlane::LocalPlane(double latitude, double longitude)
    : origin_(earth_of(latitude, longitude)),
      sin_latitude_(std::sin(latitude * kRadians)),
      cos_latitude_(std::cos(latitude * kRadians)),
      sin_longitude_(std::sin(longitude * kRadians)),
      cos_longitude_(std::cos(longitude * kRadians)) {}

LocalPlane::Earth LocalPlane::earth_of(double latitude, double longitude) {
  const double sin = std::sin(latitude * kRadians);
  const double cos = std::cos(latitude * kRadians);
  const double normal = kSemiMajorM / std::sqrt(1 - kEccentricitySquared * sin * sin);
  return {normal * cos * std::cos(longitude * kRadians),
          normal * cos * std::sin(longitude * kRadians), normal * (1 - kEccentricitySquared) * sin};
}

LocalPlane::Place LocalPlane::place_of(double latitude, double longitude) const {
  const Earth at = earth_of(latitude, longitude);
  const double x = at.x - origin_.x;
  const double y = at.y - origin_.y;
  const double z = at.z - origin_.z;
  const double outwards = x * cos_longitude_ + y * sin_longitude_;
  return {y * cos_longitude_ - x * sin_longitude_, z * cos_latitude_ - outwards * sin_latitude_};
}

}  // namespace iog::tools
