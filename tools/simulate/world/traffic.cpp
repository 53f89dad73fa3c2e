#include "tools/simulate/world/traffic.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "numeric/elementary.hpp"

namespace iog::tools {
namespace {

constexpr double kTurn = 2 * numeric::kPi;

// The car weaves in its lane.
constexpr double kWeavePeriod = 13.0;

// How far from the junction a crossing car appears and vanishes.
constexpr double kCrossingSight = 70.0;

double speed_at(const Cruise& cruise, double time_s) {
  return cruise.mean_speed +
         cruise.speed_swing * numeric::sin(kTurn * time_s / cruise.swing_period);
}

// Appends the solids of one thing after another, each with its number.
class Appender {
 public:
  Appender(double station, std::vector<Solid>& solids) : station_(station), solids_(&solids) {}

  [[nodiscard]] bool sees(double station) const { return std::abs(station - station_) < kSight; }

  void number_next() { thing_ = next_++; }
  void number(std::uint32_t thing) { thing_ = thing; }

  void add(const CarShape& shape, const Placement& at) {
    const std::size_t before = solids_->size();
    add_car(shape, at, *solids_);
    mark_from(before);
  }

  void add_walker(const Placement& at) {
    const std::size_t before = solids_->size();
    add_person(at.x, at.y, *solids_);
    mark_from(before);
  }

 private:
  void mark_from(std::size_t first) {
    for (std::size_t i = first; i < solids_->size(); ++i) {
      (*solids_)[i].thing = thing_;
    }
  }

  double station_;
  std::vector<Solid>* solids_;
  std::uint32_t next_ = kFirstMover;
  std::uint32_t thing_ = 0;
};

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
  const double slope = weave * kTurn / kWeavePeriod * numeric::cos(phase) / speed_at(*this, time_s);
  const double norm = std::sqrt(1 + slope * slope);
  const double pitch = 0.0035 * numeric::sin(kTurn * time_s / 4.3);  // 0.2 degrees
  const Placement in_lane = road.at(station, left + weave * numeric::sin(phase));
  return {.at = turned_by(in_lane, 1 / norm, slope / norm),
          .pitch_cos = numeric::cos(pitch),
          .pitch_sin = numeric::sin(pitch),
          .station = station};
}

void Traffic::append_seen_from(double station, const Road& road, const Cruise& cruise,
                               double time_s, std::vector<Solid>& solids) const {
  Appender appender(station, solids);
  for (const Companion& car : companions) {
    const double ahead = car.ahead + car.swing * numeric::sin(kTurn * time_s / car.swing_period);
    appender.number_next();
    appender.add(car.shape, road.at(cruise.station_at(time_s) + ahead, car.left));
  }
  for (const Crosser& car : crossers) {
    const double way = (time_s - car.passes_s) * car.speed;
    appender.number_next();
    if (std::abs(way) < kCrossingSight && appender.sees(car.junction)) {
      const Placement cross = turned_by(road.at(car.junction, 0), 0, car.side);
      appender.add(car.shape, moved(cross, way, car.left));
    }
  }
  for (const Car& car : cars) {
    const double there = car.station + car.speed * time_s;
    appender.number_next();
    if (appender.sees(there)) {
      const double heading = car.speed < 0 ? -1 : 1;
      appender.add(car.shape, turned_by(road.at(there, car.left), heading, 0));
    }
  }
  for (const Walker& walker : walkers) {
    const double there = walker.station + walker.speed * time_s;
    appender.number_next();
    if (appender.sees(there)) {
      appender.add_walker(road.at(there, walker.left));
    }
  }
  for (const ScriptedCar& car : scripted_cars) {
    appender.number(car.thing);
    if (appender.sees(car.timetable.station_at(time_s))) {
      appender.add(car.shape, car.at(road, time_s));
    }
  }
  for (const ScriptedWalker& walker : scripted_walkers) {
    appender.number(walker.thing);
    if (appender.sees(walker.station_at(time_s))) {
      appender.add_walker(walker.at(road, time_s));
    }
  }
}

}  // namespace iog::tools
