#include "tools/simulate/scenes/hills.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "tools/simulate/random.hpp"
#include "tools/simulate/scenes/hills_ground.hpp"
#include "tools/simulate/world/street_furniture.hpp"

namespace iog::tools {
namespace {

// The sharpest curve is that of 276 m radius: 0.3 * 2 pi / 520.
constexpr Course kCourse{
    .swings = {{{.radians = 0.3, .wavelength = 520}, {.radians = 0, .wavelength = 100}}}};

constexpr double kLane = 1.75;
constexpr Cruise kCruise{
    .mean_speed = 9.0, .speed_swing = 1.0, .swing_period = 29.0, .left = -kLane};
constexpr double kOncomingSpeed = 10.0;

constexpr double kParking = 4.6;  // from the centre line to the middle of a parked car
constexpr double kPavement = 7.2;
constexpr double kSlot = 6.5;
constexpr double kKerbPiece = 4.0;

class Builder {
 public:
  Builder(const Road& road, const Terrain& terrain, std::uint64_t seed)
      : road_(&road), terrain_(&terrain), random_(seed, 2) {}

  void add_act(double begin) {
    add_kerb(begin);
    add_gate(begin + kHillsGateM);
    add_bridge(begin + kHillsBridgeM);
    for (const double part : {15.0, 130.0}) {
      add_parked_cars(begin + part, begin + part + 45);
    }
    add_trees(begin);
    add_bushes(begin);
    add_people(begin);
    add_wall(begin + 145, begin + 175);
    add_houses(begin);
    plan_.roads.push_back({.kind = "tertiary",
                           .lanes = 2,
                           .width_m = kHillsKerb + kHillsLeftEdge,
                           .line = line_beside(*road_, begin, begin + kHillsActM,
                                               (kHillsLeftEdge - kHillsKerb) / 2)});
  }

  void finish(Scene& scene) {
    landscape_.sort();
    scene.landscape = std::move(landscape_);
    scene.plan = std::move(plan_);
  }

 private:
  // The solids are the parts of one thing, by the first of which the others stand.
  void keep(double station) {
    terrain_->put(fresh_);
    std::ranges::stable_sort(fresh_, {}, &Solid::z_low);  // what hangs is a part of what stands
    landscape_.place(station, fresh_);
  }

  void add_kerb(double begin) {
    for (const double station : stations(begin, begin + kHillsActM, kKerbPiece)) {
      fresh_.push_back(box(Material::kKerb, road_->at(station + kKerbPiece / 2, -kHillsKerb),
                           kKerbPiece, kHillsKerbWidth, -0.3, kHillsKerbHeight / 2));
      keep(station);
    }
  }

  // Two posts and a beam between them, which hangs over the middle of the road.
  void add_gate(double station) {
    const Placement middle = road_->at(station, -1);
    fresh_.push_back(box(Material::kPole, middle, 0.12, 10.8, 2.5, 2.7));
    for (const double left : {5.3, -5.3}) {
      const Placement post = moved(middle, 0, left);
      fresh_.push_back(cylinder(Material::kPole, post.x, post.y, 0.08, -1, 2.7));
    }
    keep(station);
  }

  void add_bridge(double station) {
    const Placement middle = road_->at(station, 0);
    fresh_.push_back(box(Material::kRail, middle, 8, 30, 4.6, 5.6));
    for (const double left : {12.0, -12.0}) {
      fresh_.push_back(box(Material::kBank, moved(middle, 0, left), 8, 6, -6, 4.6));
    }
    keep(station);
  }

  // Up on the bank and down behind the other one.
  void add_houses(double begin) {
    for (const double station : stations(begin + 6, begin + kHillsActM, 24)) {
      for (const double left : {32.0, -30.0}) {
        const Placement at = road_->at(station, left + random_.between(-3, 3));
        const double length = random_.between(9, 15);
        const double width = random_.between(8, 12);
        fresh_.push_back(box(Material::kWall, at, length, width, -3, random_.between(4, 9)));
        plan_.houses.push_back(house_of(fresh_.back()));
        keep(station);
      }
    }
  }

  void add_parked_cars(double from, double to) {
    const double share = random_.between(0.5, 0.9);
    for (const double station : stations(from, to, kSlot)) {
      if (!random_.chance(share)) {
        continue;
      }
      const double left = -kParking + random_.between(-0.15, 0.15);
      const double askew = random_.between(-0.03, 0.03);
      add_glazed_car(some_car(random_), turned_by(road_->at(station, left), 1, askew), fresh_);
      keep(station);
    }
  }

  // Along the pavement and up on the bank. Crowns reach over the road.
  void add_trees(double begin) {
    for (const double station : stations(begin + 5, begin + kHillsActM, 11)) {
      const bool is_on_bank = random_.chance(0.6);
      const double left = is_on_bank ? random_.between(11, 24) : -8.0;
      const Placement at = road_->at(station + random_.between(-3, 3), left);
      add_tree(at.x, at.y, random_, fresh_);
      fresh_.front().z_low = -0.5;
      keep(station);
    }
  }

  void add_bushes(double begin) {
    for (const double station : stations(begin + 2, begin + kHillsActM, 7)) {
      const double left = random_.chance(0.5) ? random_.between(7, 20) : -random_.between(12, 22);
      const Placement at = road_->at(station, left);
      add_bush(at.x, at.y, random_, fresh_);
      fresh_.front().z_low = -0.5;
      keep(station);
    }
  }

  void add_people(double begin) {
    for (const double station : stations(begin + 20, begin + kHillsActM, 60)) {
      const Placement at = road_->at(station, -kPavement + random_.between(-0.4, 0.6));
      add_person(at.x, at.y, fresh_);
      keep(station);
    }
  }

  void add_wall(double from, double to) {
    for (const double station : stations(from, to, 3)) {
      fresh_.push_back(box(Material::kWall, road_->at(station + 1.5, -8.6), 3.05, 0.4, -1.5, 1.6));
      keep(station);
    }
  }

  const Road* road_;
  const Terrain* terrain_;
  Random random_;
  std::vector<Solid> fresh_;  // the parts of one thing
  Landscape landscape_;
  SitePlan plan_;
};

Traffic make_traffic(std::uint64_t seed, double drive_m, double drive_s) {
  Random random(seed, 3);
  Traffic traffic;
  traffic.companions.push_back(
      {.ahead = 24, .swing = 5, .swing_period = 23, .left = -kLane, .shape = some_car(random)});
  traffic.companions.push_back(
      {.ahead = -16, .swing = 4, .swing_period = 31, .left = -kLane, .shape = some_car(random)});
  double station = 40;
  while (station < drive_m + kSight + kOncomingSpeed * drive_s) {
    traffic.cars.push_back(
        {.station = station, .left = kLane, .speed = -kOncomingSpeed, .shape = some_car(random)});
    station += random.between(40, 120);
  }
  station = -kSight;
  while (station < drive_m + kSight) {
    const double pace = random.between(0.9, 1.6);
    traffic.walkers.push_back({.station = station,
                               .left = -kPavement + random.between(-0.6, 0.8),
                               .speed = random.chance(0.5) ? pace : -pace});
    station += random.between(12, 35);
  }
  return traffic;
}

}  // namespace

Scene make_hills(std::uint64_t seed, double drive_s) {
  const double drive_m = kCruise.station_at(drive_s);
  const Road road(kCourse, -2 * kSight, drive_m + 2 * kSight + kHillsActM);
  const auto terrain = std::make_shared<const Terrain>(road, HillsGround(seed));
  Builder builder(road, *terrain, seed);
  for (double begin = -kHillsActM; begin < drive_m + kSight; begin += kHillsActM) {
    builder.add_act(begin);
  }
  Scene scene{.road = road,
              .cruise = kCruise,
              .landscape = {},
              .traffic = make_traffic(seed, drive_m, drive_s),
              .terrain = terrain};
  builder.finish(scene);
  return scene;
}

}  // namespace iog::tools
