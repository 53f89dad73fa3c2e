#include "tools/simulate/scenes/street.hpp"

#include <utility>

#include "tools/simulate/random.hpp"
#include "tools/simulate/scenes/city_street.hpp"

namespace iog::tools {
namespace {

// The same in every act. The sharpest curve is that of 58 m radius: 0.16 * 2 pi / 80 + 0.03 * 2 pi
// / 40.
constexpr Course kCourse{.swings = {{{.radians = -0.16, .wavelength = kStreetActM},
                                     {.radians = -0.03, .wavelength = kStreetActM / 2}}}};

// An act takes one swing. A car that hardly moves does not weave.
constexpr Cruise kCruise{.mean_speed = kStreetActM / kStreetActS,
                         .speed_swing = 3.9,
                         .swing_period = kStreetActS,
                         .left = -kCityLane,
                         .weave = 0};

constexpr double kKerbside = 4.65;  // the middle of a parked car
constexpr double kOtherLane = 1.60;
constexpr CarShape kBus{.length = 12.0,
                        .width = 2.55,
                        .bonnet_height = 3.1,
                        .roof_height = 3.1,
                        .cabin_share = 0,
                        .clearance = 0.30};
constexpr double kBusKerbside = 4.65;
// It keeps to the middle of the road, because of the bus: even in a curve there is room between. No
// beam passes below it and meets the bus.
constexpr CarShape kDeliveryLorry{.length = 14,
                                  .width = 2.5,
                                  .bonnet_height = 3.9,
                                  .roof_height = 3.9,
                                  .cabin_share = 0,
                                  .clearance = 0.20};
constexpr double kBesideBus = 1.30;

// Adds the roles of one act, which begins at that time and station.
class Act {
 public:
  Act(int number, Traffic& traffic)
      : number_(number),
        time_s_(number * kStreetActS),
        station_(number * kStreetActM),
        traffic_(&traffic) {}

  void add() {
    add_car(StreetRole::kVisitor, 1,
            {{2.5, 40, 0}, {5.5, 49.75, 6.5}, {9.5, 75.75, 6.5}, {14.62, 92.4, 0}},
            {{40, -kKerbside}, {50, -kCityLane}, {80.4, -kCityLane}, {92.4, -kKerbside}},
            CarShape{});
    // It stands until its first call and after its last one: their speeds are 0.
    add_car(StreetRole::kLeaver, 1, {{15, 80.4, 0}, {19, 96.4, 8}},
            {{80.4, -kKerbside}, {89.4, -kCityLane}}, CarShape{});
    add_car(StreetRole::kOncomer, -1, {{5, 100.4, -9}}, {{0, kOtherLane}}, CarShape{});
    add_car(StreetRole::kDelivery, -1,
            {{11, 113.4, -11}, {15.2, 90, 0}, {18.5, 90, 0}, {26, 56.25, -9}}, {{0, kBesideBus}},
            kDeliveryLorry);
    add_car(StreetRole::kBus, -1, {{22, 100.4, 0}, {30, 68.4, -8}},
            {{70.4, kOtherLane}, {100.4, kBusKerbside}}, kBus);
    add_walker(StreetRole::kCrosser, {{0, 66.2, 7},
                                      {8, 77.4, 7},
                                      {10.5, 77.4, 7},
                                      {19.375, 77.4, -7.2},
                                      {22, 77.4, -7.2},
                                      {42, 103.4, -7.2}});
    add_walker(StreetRole::kStroller,
               {{4, 104, -7.3}, {13, 93.2, -7.3}, {18, 93.2, -7.3}, {28, 81.2, -7.3}});
  }

  // Nothing is parked where somebody has to park, leave or cross.
  void make_room(const Road& road, Landscape& landscape) const {
    landscape.clear_of_cars(road, station_ + 34, station_ + 54, -1);
    landscape.clear_of_cars(road, station_ + 72, station_ + 100, -1);
    landscape.clear_of_cars(road, station_ + 40, station_ + 112, 1);
  }

 private:
  void add_car(StreetRole role, double direction, std::vector<Timetable::Call> calls,
               std::vector<ScriptedCar::Knot> path, const CarShape& shape) {
    for (Timetable::Call& call : calls) {
      call.time_s += time_s_;
      call.station += station_;
    }
    for (ScriptedCar::Knot& knot : path) {
      knot.station += station_;
    }
    traffic_->scripted_cars.push_back({.thing = street_thing(number_, role),
                                       .timetable = Timetable(std::move(calls)),
                                       .path = std::move(path),
                                       .direction = direction,
                                       .shape = shape});
  }

  void add_walker(StreetRole role, std::vector<ScriptedWalker::Place> places) {
    for (ScriptedWalker::Place& place : places) {
      place.time_s += time_s_;
      place.station += station_;
    }
    traffic_->scripted_walkers.push_back(
        {.thing = street_thing(number_, role), .places = std::move(places)});
  }

  int number_;
  double time_s_;
  double station_;
  Traffic* traffic_;
};

// People who walk up and down the pavement, and stop now and then.
void add_passers_by(double drive_s, double drive_m, Random& random, Traffic& traffic) {
  double station = -kSight;
  while (station < drive_m + kSight) {
    const double side = random.chance(0.5) ? 1 : -1;
    const double left = side * (kPavementCentre + random.between(0.2, 1.2));
    const double pace = (random.chance(0.5) ? 1 : -1) * random.between(0.9, 1.6);
    ScriptedWalker walker{
        .thing = kFirstMover + static_cast<std::uint32_t>(traffic.scripted_walkers.size()),
        .places = {{0, station, left}}};
    while (walker.places.back().time_s < drive_s) {
      const double walks_s = random.between(4, 15);
      const double stands_s = random.between(2, 8);
      const ScriptedWalker::Place from = walker.places.back();
      const double to = from.station + pace * walks_s;
      walker.places.push_back({from.time_s + walks_s, to, left});
      walker.places.push_back({from.time_s + walks_s + stands_s, to, left});
    }
    traffic.scripted_walkers.push_back(std::move(walker));
    station += random.between(10, 25);
  }
}

}  // namespace

Scene make_street(std::uint64_t seed, double drive_s) {
  const double drive_m = kCruise.station_at(drive_s);
  const Road road(kCourse, -kSight - 60, drive_m + kSight + 300);
  CityStreet street = make_city_street(road, seed, drive_m);
  Random random(seed, 6);
  Traffic traffic;
  add_passers_by(drive_s, drive_m, random, traffic);
  for (int number = -1; number * kStreetActM < drive_m + kSight; ++number) {
    Act act(number, traffic);
    act.add();
    act.make_room(road, street.landscape);
  }
  return {road, kCruise, std::move(street.landscape), std::move(traffic), std::move(street.plan)};
}

}  // namespace iog::tools
