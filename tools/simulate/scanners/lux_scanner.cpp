#include "tools/simulate/scanners/lux_scanner.hpp"

#include <algorithm>
#include <cmath>

#include "lidar/ibeo_lux.hpp"
#include "numeric/elementary.hpp"
#include "tools/car/mount.hpp"
#include "tools/car/tilted_mirror.hpp"
#include "tools/simulate/scanners/echo_model.hpp"

namespace iog::tools {
namespace {

constexpr double kHalfBeam = 0.04 * numeric::kPi / 180;  // radians; the LUX's beam is 0.08 degrees
constexpr double kSeparation = 0.9;  // echoes nearer to one another than this are one
constexpr double kFoliagePass = 0.45;

double angle_of(std::size_t column) {
  const auto ticks = kLuxEdgeTicks - static_cast<std::int32_t>(column) * kLuxStepTicks;
  return ticks * 2 * numeric::kPi / lidar::IbeoLux::kTicksPerTurn;
}

}  // namespace

LuxScanner::LuxScanner(const description::SensorConfig& config) : mount_(frame_of(config.mount)) {
  const double tilt = description::radians(config.beam_tilt_deg);
  for (std::size_t column = 0; column < kLuxAzimuths; ++column) {
    const double angle = angle_of(column);
    for (std::size_t layer = 0; layer < kLuxLayers; ++layer) {
      const double flat = lidar::IbeoLux::kElevationsDeg[layer] * numeric::kPi / 180;
      for (const bool looks_up : {false, true}) {
        const double elevation = description::tilted_elevation(flat, looks_up, tilt, angle);
        for (std::size_t edge = 0; edge < 2; ++edge) {
          const double azimuth = edge == 0 ? angle - kHalfBeam : angle + kHalfBeam;
          edges_[looks_up ? 1 : 0][column][layer][edge] = {
              numeric::cos(elevation) * numeric::cos(azimuth),
              numeric::cos(elevation) * numeric::sin(azimuth), numeric::sin(elevation)};
        }
      }
    }
  }
}

// Finds the echoes of one beam, nearest first and apart from one another.
void LuxScanner::follow(const RayCaster& rays, const SensorFrame& frame, double time_s,
                        const std::array<Vector3, 2>& edges, Random& random) {
  echoes_.clear();
  std::array<Hit, 2> hits;
  std::array<PointTruth, 2> truths;
  for (std::size_t edge = 0; edge < 2; ++edge) {
    const Ray ray{frame.origin, frame.direction(edges[edge])};
    hits[edge] = rays.nearest(ray, time_s);
    truths[edge] = rays.truth_of(ray, hits[edge]);
    if (hits[edge].material == Material::kFoliage && random.chance(kFoliagePass)) {
      const double beyond = hits[edge].distance + random.between(0.2, 1.5);
      const Hit behind = rays.nearest(ray, time_s, beyond);
      echoes_.push_back({behind.distance, 0.3, behind.material, rays.truth_of(ray, behind)});
    }
  }
  const double gap = std::abs(hits[0].distance - hits[1].distance);
  if (gap < 0.3 + 0.05 * std::min(hits[0].distance, hits[1].distance)) {
    const double middle = (hits[0].distance + hits[1].distance) / 2;
    echoes_.push_back({middle, 1.0, hits[0].material, truths[0]});
  } else {
    echoes_.push_back({hits[0].distance, 0.5, hits[0].material, truths[0]});
    echoes_.push_back({hits[1].distance, 0.5, hits[1].material, truths[1]});
  }
  std::ranges::stable_sort(echoes_, {}, &Echo::distance);
}

void LuxScanner::add_points(std::size_t column, std::size_t layer, Random& random,
                            LuxEchoes& scan) const {
  const auto ticks = kLuxEdgeTicks - static_cast<std::int32_t>(column) * kLuxStepTicks;
  LuxPoint point{.layer = static_cast<std::uint8_t>(layer),
                 .angle_ticks = static_cast<std::int16_t>(ticks)};
  const auto add = [&](const PointTruth& truth) {
    scan.points.push_back(point);
    scan.truth.push_back(truth);
    ++point.echo;
  };
  if (add_clutter(random, point)) {
    add({.what = PointClass::kClutter});
  }
  double last = -kSeparation;
  for (const Echo& echo : echoes_) {
    if (echo.distance - last < kSeparation || point.echo >= lidar::IbeoLux::kMaxEchoes ||
        !comes_back(echo.material, echo.distance, echo.strength, random)) {
      continue;
    }
    last = echo.distance;
    measure(echo.material, echo.distance, echo.strength, random, point);
    add(echo.truth);
  }
}

LuxEchoes LuxScanner::scan(const RayCaster& rays, double from_s, double to_s, MirrorSide side,
                           Random& random) {
  LuxEchoes scan;
  for (std::size_t column = 0; column < kLuxAzimuths; ++column) {
    const double share = static_cast<double>(column) / (kLuxAzimuths - 1);
    const double time_s = from_s + share * (to_s - from_s);
    const SensorFrame frame = rays.frame_at(time_s);
    for (std::size_t layer = 0; layer < kLuxLayers; ++layer) {
      follow(rays, frame, time_s, edges_of(side)[column][layer], random);
      add_points(column, layer, random, scan);
    }
  }
  return scan;
}

}  // namespace iog::tools
