#include "tools/clouds/laser_table.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "lidar/formats.hpp"
#include "numeric/elementary.hpp"

namespace iog::tools {
namespace {

constexpr double kNearM = 0.01;
constexpr double kNearPerM = 0.25 * numeric::kPi / 180;
constexpr double kSureM = 0.005;
constexpr double kSurePerM = 0.06 * numeric::kPi / 180;

}  // namespace

LaserTable::LaserTable(const description::SensorConfig& config) {
  std::vector<lidar::Laser> lasers(config.lasers.begin(), config.lasers.end());
  lidar::with_decoder(config.format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    for (std::size_t i = lasers.size(); i < Decoder::kElevationsDeg.size(); ++i) {
      lasers.push_back({.elevation_deg = Decoder::kElevationsDeg.at(i)});
    }
  });
  for (const lidar::Laser& laser : lasers) {
    const double elevation = laser.elevation_deg * numeric::kPi / 180;
    const double cosine = numeric::cos(elevation);
    const double rise = numeric::sin(elevation) / cosine;
    cones_.push_back({.rise = rise,
                      .height_m = laser.height_m / cosine,
                      .cosine = cosine,
                      .more_m = laser.height_m * rise - laser.range_m,
                      .left = laser.azimuth_deg / 360});
  }
}

std::optional<LaserPoint> LaserTable::laser_of(double x, double y, double z) const {
  const double r = std::sqrt(x * x + y * y);
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t layer = 0;
  for (std::size_t i = 0; i < cones_.size(); ++i) {
    const double off = std::abs(z - cones_[i].height_m - r * cones_[i].rise);
    if (off < nearest) {
      nearest = off;
      layer = i;
    }
  }
  if (!(nearest <= kNearM + kNearPerM * r)) {
    return std::nullopt;
  }
  const Cone& cone = cones_[layer];
  return LaserPoint{.layer = layer,
                    .range_m = r / cone.cosine + cone.more_m,
                    .right = cone.left - std::atan2(y, x) / (2 * numeric::kPi),
                    .off_m = nearest,
                    .is_sure = nearest <= kSureM + kSurePerM * r};
}

}  // namespace iog::tools
