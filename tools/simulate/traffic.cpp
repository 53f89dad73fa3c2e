#include "tools/simulate/traffic.hpp"

#include <cmath>

#include "numeric/elementary.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools {
namespace {

constexpr double kTurn = 2 * numeric::kPi;

// The car's speed swings between 6.5 and 11.5 m/s.
constexpr double kMeanSpeed = 9.0;
constexpr double kSpeedSwing = 2.5;
constexpr double kSpeedPeriod = 41.0;

constexpr double kOncomingSpeed = 9.0;
constexpr double kCrossingSpeed = 7.0;
constexpr double kCrossingSight = 70.0;

// The car weaves in its lane.
constexpr double kWeave = 0.15;
constexpr double kWeavePeriod = 13.0;

double ego_speed(double time_s) {
  return kMeanSpeed + kSpeedSwing * numeric::sin(kTurn * time_s / kSpeedPeriod);
}

double time_at_station(double station) {
  double low = 0;
  double high = 800;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (ego_station(middle) < station ? low : high) = middle;
  }
  return low;
}

}  // namespace

double ego_station(double time_s) {
  return kMeanSpeed * time_s +
         kSpeedSwing * kSpeedPeriod / kTurn * (1 - numeric::cos(kTurn * time_s / kSpeedPeriod));
}

Traffic::Traffic(const City& city, std::uint64_t seed, double drive_s) : city_(&city) {
  Random random(seed, 3);
  leader_ = some_car(random);
  follower_ = some_car(random);
  const double drive_m = ego_station(drive_s);
  double station = -kSight;
  while (station < drive_m + kSight) {
    const double side = random.chance(0.5) ? 1 : -1;
    const double pace = random.between(0.9, 1.6);
    walkers_.push_back({.station = station,
                        .left = side * (kPavementCentre + random.between(-0.9, 1.2)),
                        .speed = random.chance(0.5) ? pace : -pace});
    station += random.between(6, 18);
  }
  const double last_oncomer = drive_m + kSight + kOncomingSpeed * drive_s;
  station = 30;
  while (station < last_oncomer) {
    oncomers_.push_back({.station = station, .shape = some_car(random)});
    station += random.between(25, 95);
  }
  for (const double junction : city.junctions()) {
    // The crossing car passes while the junction is still well ahead.
    if (junction > 40) {
      crossers_.push_back({.junction = junction,
                           .passes_s = time_at_station(junction - 40),
                           .side = random.chance(0.5) ? 1.0 : -1.0,
                           .shape = some_car(random)});
    }
  }
}

EgoPose Traffic::ego(double time_s) const {
  const double station = ego_station(time_s);
  const double phase = kTurn * time_s / kWeavePeriod;
  const double left = -kLaneCentre + kWeave * numeric::sin(phase);
  const double slope = kWeave * kTurn / kWeavePeriod * numeric::cos(phase) / ego_speed(time_s);
  const double norm = std::sqrt(1 + slope * slope);
  const double pitch = 0.0035 * numeric::sin(kTurn * time_s / 4.3);  // 0.2 degrees
  return {.at = turned_by(city_->road().at(station, left), 1 / norm, slope / norm),
          .pitch_cos = numeric::cos(pitch),
          .pitch_sin = numeric::sin(pitch),
          .station = station};
}

bool Traffic::is_seen(double station, double time_s) const {
  return std::abs(station - ego_station(time_s)) < kSight;
}

void Traffic::append_followers(double time_s, std::vector<Solid>& solids) const {
  const double ego = ego_station(time_s);
  const double ahead = 24 + 7 * numeric::sin(kTurn * time_s / 23);
  const double behind = 15 + 4 * numeric::sin(kTurn * time_s / 31);
  add_car(leader_, city_->road().at(ego + ahead, -kLaneCentre), solids);
  add_car(follower_, city_->road().at(ego - behind, -kLaneCentre), solids);
}

void Traffic::append_crossers(double time_s, std::vector<Solid>& solids) const {
  for (const Crosser& crosser : crossers_) {
    const double way = (time_s - crosser.passes_s) * kCrossingSpeed;
    if (std::abs(way) < kCrossingSight && is_seen(crosser.junction, time_s)) {
      const Placement cross = turned_by(city_->road().at(crosser.junction, 0), 0, crosser.side);
      add_car(crosser.shape, moved(cross, way, -kLaneCentre), solids);
    }
  }
}

void Traffic::append_at(double time_s, std::vector<Solid>& solids) const {
  append_followers(time_s, solids);
  append_crossers(time_s, solids);
  for (const Oncomer& car : oncomers_) {
    const double station = car.station - kOncomingSpeed * time_s;
    if (is_seen(station, time_s)) {
      add_car(car.shape, turned_by(city_->road().at(station, kLaneCentre), -1, 0), solids);
    }
  }
  for (const Walker& walker : walkers_) {
    const double station = walker.station + walker.speed * time_s;
    if (is_seen(station, time_s)) {
      const Placement at = city_->road().at(station, walker.left);
      add_person(at.x, at.y, solids);
    }
  }
}

}  // namespace iog::tools
