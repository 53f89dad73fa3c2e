#include "tools/simulate/scenes/city.hpp"

#include <span>
#include <utility>

#include "tools/simulate/random.hpp"
#include "tools/simulate/scenes/city_street.hpp"

namespace iog::tools {
namespace {

// The sharpest curve is that of 95 m radius: 0.25 * 2 pi / 310 + 0.15 * 2 pi / 173.
constexpr Course kCourse{
    .swings = {{{.radians = 0.25, .wavelength = 310}, {.radians = 0.15, .wavelength = 173}}}};

// Between 6.5 and 11.5 m/s.
constexpr Cruise kCruise{
    .mean_speed = 9.0, .speed_swing = 2.5, .swing_period = 41.0, .left = -kCityLane};

constexpr double kOncomingSpeed = 9.0;
constexpr double kCrossingSpeed = 7.0;

// A car ahead and one behind in the lane of the car itself.
void add_companions(Random& random, Traffic& traffic) {
  traffic.companions.push_back(
      {.ahead = 24, .swing = 7, .swing_period = 23, .left = -kCityLane, .shape = some_car(random)});
  traffic.companions.push_back({.ahead = -15,
                                .swing = -4,
                                .swing_period = 31,
                                .left = -kCityLane,
                                .shape = some_car(random)});
}

void add_walkers(double drive_m, Random& random, Traffic& traffic) {
  double station = -kSight;
  while (station < drive_m + kSight) {
    const double side = random.chance(0.5) ? 1 : -1;
    const double pace = random.between(0.9, 1.6);
    traffic.walkers.push_back({.station = station,
                               .left = side * (kPavementCentre + random.between(-0.9, 1.2)),
                               .speed = random.chance(0.5) ? pace : -pace});
    station += random.between(6, 18);
  }
}

void add_oncomers(double drive_m, double drive_s, Random& random, Traffic& traffic) {
  const double last = drive_m + kSight + kOncomingSpeed * drive_s;
  double station = 30;
  while (station < last) {
    traffic.cars.push_back({.station = station,
                            .left = kCityLane,
                            .speed = -kOncomingSpeed,
                            .shape = some_car(random)});
    station += random.between(25, 95);
  }
}

void add_crossers(std::span<const double> junctions, Random& random, Traffic& traffic) {
  for (const double junction : junctions) {
    // The crossing car passes while the junction is still well ahead.
    if (junction > 40) {
      traffic.crossers.push_back({.junction = junction,
                                  .passes_s = kCruise.time_at(junction - 40),
                                  .left = -kCityLane,
                                  .speed = kCrossingSpeed,
                                  .side = random.chance(0.5) ? 1.0 : -1.0,
                                  .shape = some_car(random)});
    }
  }
}

}  // namespace

Scene make_city(std::uint64_t seed, double drive_s) {
  const double drive_m = kCruise.station_at(drive_s);
  const Road road(kCourse, -kSight - 60, drive_m + kSight + 300);
  CityStreet street = make_city_street(road, seed, drive_m);
  Random random(seed, 3);
  Traffic traffic;
  add_companions(random, traffic);
  add_walkers(drive_m, random, traffic);
  add_oncomers(drive_m, drive_s, random, traffic);
  add_crossers(street.junctions, random, traffic);
  return {road, kCruise, std::move(street.landscape), std::move(traffic), std::move(street.plan)};
}

}  // namespace iog::tools
