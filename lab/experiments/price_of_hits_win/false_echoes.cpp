#include "lab/experiments/price_of_hits_win/false_echoes.hpp"

#include <algorithm>
#include <cmath>

#include "description/mount.hpp"
#include "lidar/ibeo_lux.hpp"
#include "numeric/elementary.hpp"
#include "tools/simulate/scanners/echo_model.hpp"
#include "tools/simulate/scanners/ray_caster.hpp"

namespace iog::lab {
namespace {

constexpr double kNearestDropMm = 1000;
constexpr double kRangeSigmaMm = 70;  // as the simulated LUX measures
constexpr std::uint8_t kMostEchoes = lidar::IbeoLux::kMaxEchoes;

bool is_dropped(const lidar::ScanPoint& point) { return point.is_dirt || point.is_rain; }

// The drop's range; 0 if there is no room for one.
std::uint32_t range_of_drop(const lidar::ScanPoint& first, const vehicle::Sensor& sensor,
                            tools::Random& random) {
  const double farthest = std::min(first.range_mm, sensor.range.mm());
  return farthest <= kNearestDropMm
             ? 0
             : static_cast<std::uint32_t>(random.between(kNearestDropMm, farthest));
}

// How far along the beam of that point the ghost is; 0 if the beam misses it.
double range_to_ghost(const SensorPoint& seen, const description::SensorConfig& sensor,
                      const Ghost& ghost) {
  constexpr double kPerTick = 2 * numeric::kPi / lidar::IbeoLux::kTicksPerTurn;
  const double yaw =
      seen.point.azimuth_ticks * kPerTick + description::radians(sensor.mount.yaw_deg);
  const double ahead_m = ghost.x_m - sensor.mount.x_m;
  if (numeric::cos(yaw) <= 0 || ahead_m <= 0) {
    return 0;
  }
  const double aside_m = sensor.mount.y_m + ahead_m * numeric::sin(yaw) / numeric::cos(yaw);
  return std::abs(aside_m) > ghost.half_width_m ? 0 : ahead_m / numeric::cos(yaw) * 1000;
}

lidar::ScanPoint point_of(const tools::LuxPoint& seen) {
  const int ticks = seen.angle_ticks + (seen.angle_ticks < 0 ? lidar::IbeoLux::kTicksPerTurn : 0);
  return {.range_mm = seen.range_cm * 10U,
          .azimuth_ticks = static_cast<std::uint16_t>(ticks),
          .layer = seen.layer,
          .echo = seen.echo,
          .is_ground = (seen.flags & tools::kLuxGround) != 0,
          .is_dirt = (seen.flags & tools::kLuxDirt) != 0,
          .is_rain = (seen.flags & tools::kLuxRain) != 0};
}

}  // namespace

Rained with_rain(const FramePoints& points, const vehicle::Vehicle& vehicle, double rate,
                 TrueEcho fate, tools::Random& random) {
  Rained rained;
  bool is_wet = false;  // the beam that the points are of
  for (SensorPoint seen : points) {
    if (seen.point.echo == 0) {
      const vehicle::Sensor& sensor = vehicle.sensors[seen.sensor];
      const bool is_chosen = random.chance(rate);
      const std::uint32_t range_mm =
          is_chosen && !is_dropped(seen.point) ? range_of_drop(seen.point, sensor, random) : 0;
      is_wet = range_mm > 0;
      if (is_wet) {
        SensorPoint drop = seen;
        drop.point = {.range_mm = range_mm,
                      .azimuth_ticks = seen.point.azimuth_ticks,
                      .layer = seen.point.layer};
        rained.points.push_back(drop);
        ++rained.drops;
      }
    }
    if (is_wet) {
      ++seen.point.echo;
      if (fate == TrueEcho::kIsLost || seen.point.echo >= kMostEchoes) {
        continue;
      }
    }
    rained.points.push_back(seen);
  }
  return rained;
}

FramePoints with_ghost(const FramePoints& points, const tools::CatalogueEntry& car,
                       const Ghost& ghost, tools::Random& random) {
  FramePoints haunted;
  bool is_hidden = false;  // the rest of the beam
  for (SensorPoint seen : points) {
    if (seen.sensor == ghost.sensor) {
      const double range_mm = range_to_ghost(seen, car.sensors[seen.sensor], ghost);
      const bool is_behind = range_mm > 0 && seen.point.range_mm > range_mm;
      if (is_behind && seen.point.echo > 0 && is_hidden) {
        continue;
      }
      is_hidden = is_behind;
      if (is_behind) {
        seen.point.range_mm = static_cast<std::uint32_t>(range_mm + kRangeSigmaMm * random.bell());
      }
    }
    haunted.push_back(seen);
  }
  return haunted;
}

StandingCar::StandingCar(const tools::CatalogueEntry& car) {
  for (const description::SensorConfig& sensor : car.sensors) {
    scanners_.emplace_back(sensor);
  }
}

FramePoints StandingCar::look_at(std::span<const tools::Solid> solids, tools::Random& random) {
  FramePoints points;
  for (std::size_t sensor = 0; sensor < scanners_.size(); ++sensor) {
    tools::LuxScanner& scanner = scanners_[sensor];
    const tools::RayCaster rays(tools::placed(scanner.mount(), {}), solids, tools::kLuxFarthest);
    const tools::LuxEchoes scan = scanner.scan(rays, 0, 0, tools::MirrorSide::kFront, random);
    for (const tools::LuxPoint& seen : scan.points) {
      points.push_back({.sensor = sensor, .point = point_of(seen)});
    }
  }
  return points;
}

}  // namespace iog::lab
