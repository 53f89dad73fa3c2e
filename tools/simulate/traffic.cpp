#include "tools/simulate/traffic.hpp"

#include <cmath>

#include "numeric/elementary.hpp"

namespace iog::tools {
namespace {

constexpr double kTurn = 2 * numeric::kPi;

// The car weaves in its lane.
constexpr double kWeave = 0.15;
constexpr double kWeavePeriod = 13.0;

// How far from the junction a crossing car appears and vanishes.
constexpr double kCrossingSight = 70.0;

double speed_at(const Cruise& cruise, double time_s) {
  return cruise.mean_speed +
         cruise.speed_swing * numeric::sin(kTurn * time_s / cruise.swing_period);
}

}  // namespace

double Cruise::station_at(double time_s) const {
  return mean_speed * time_s +
         speed_swing * swing_period / kTurn * (1 - numeric::cos(kTurn * time_s / swing_period));
}

double Cruise::time_at(double station) const {
  double low = 0;
  double high = 800;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (station_at(middle) < station ? low : high) = middle;
  }
  return low;
}

EgoPose Cruise::pose_at(const Road& road, double time_s) const {
  const double station = station_at(time_s);
  const double phase = kTurn * time_s / kWeavePeriod;
  const double slope =
      kWeave * kTurn / kWeavePeriod * numeric::cos(phase) / speed_at(*this, time_s);
  const double norm = std::sqrt(1 + slope * slope);
  const double pitch = 0.0035 * numeric::sin(kTurn * time_s / 4.3);  // 0.2 degrees
  const Placement in_lane = road.at(station, left + kWeave * numeric::sin(phase));
  return {.at = turned_by(in_lane, 1 / norm, slope / norm),
          .pitch_cos = numeric::cos(pitch),
          .pitch_sin = numeric::sin(pitch),
          .station = station};
}

void Traffic::append_seen_from(double station, const Road& road, double time_s,
                               std::vector<Solid>& solids) const {
  const auto is_seen = [&](double there) { return std::abs(there - station) < kSight; };
  for (const Companion& car : companions) {
    const double ahead = car.ahead + car.swing * numeric::sin(kTurn * time_s / car.swing_period);
    add_car(car.shape, road.at(station + ahead, car.left), solids);
  }
  for (const Crosser& car : crossers) {
    const double way = (time_s - car.passes_s) * car.speed;
    if (std::abs(way) < kCrossingSight && is_seen(car.junction)) {
      const Placement cross = turned_by(road.at(car.junction, 0), 0, car.side);
      add_car(car.shape, moved(cross, way, car.left), solids);
    }
  }
  for (const Car& car : cars) {
    const double there = car.station + car.speed * time_s;
    if (is_seen(there)) {
      const double heading = car.speed < 0 ? -1 : 1;
      add_car(car.shape, turned_by(road.at(there, car.left), heading, 0), solids);
    }
  }
  for (const Walker& walker : walkers) {
    const double there = walker.station + walker.speed * time_s;
    if (is_seen(there)) {
      const Placement at = road.at(there, walker.left);
      add_person(at.x, at.y, solids);
    }
  }
}

}  // namespace iog::tools
