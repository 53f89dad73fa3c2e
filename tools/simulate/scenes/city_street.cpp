#include "tools/simulate/scenes/city_street.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tools/simulate/random.hpp"
#include "tools/simulate/world/street_furniture.hpp"

namespace iog::tools {
namespace {

constexpr double kParkingCentre = 4.65;
constexpr double kKerb = 5.80;
constexpr double kKerbWidth = 0.15;
constexpr double kKerbToKerb = 2 * kKerb - kKerbWidth;
constexpr double kHalfJunction = 8.0;

constexpr double kSlot = 6.3;          // length of road for one parked car
constexpr double kKerbPiece = 4.0;     // short enough to follow the curve
constexpr double kCrossStreet = 75.0;  // how far it is known from the centre line
constexpr std::array kSides{1.0, -1.0};

// Builds piece by piece and remembers at which station each piece stands.
class Builder {
 public:
  Builder(const Road& road, std::uint64_t seed) : road_(&road), random_(seed, 2) {}

  void add_block(double from, double to) {
    for (const double side : kSides) {
      add_kerb(from, to, side);
      add_parked_cars(from + 3, to - 3, side);
      add_pavement(from, to, side);
      if (random_.chance(0.75)) {
        add_buildings(from, to, side);
      } else {
        add_park(from, to, side);
      }
    }
  }

  void add_junction(double station) {
    for (const double side : kSides) {
      const Placement middle = road_->at(station, 0);
      const Placement cross = turned_by(middle, 0, side);
      for (const double bank : kSides) {
        const double left = bank * kParkingCentre;
        for (const double out : stations(20, kCrossStreet - 10, kSlot)) {
          if (random_.chance(0.6)) {
            add_car(some_car(random_), moved(cross, out, left), fresh_);
          }
        }
        fresh_.push_back(cylinder(Material::kPole, moved(cross, kKerb + 0.6, bank * 7.2).x,
                                  moved(cross, kKerb + 0.6, bank * 7.2).y, 0.09, 0, 4.5));
      }
      const double front = random_.between(0.6, 1.0) * kCrossStreet;
      add_house(box(Material::kWall, moved(cross, front + 5, 0), 10, 26, 0, 12));
      plan_.roads.push_back({.kind = "residential",
                             .lanes = 2,
                             .width_m = kKerbToKerb,
                             .line = {cross, moved(cross, front, 0)}});
      keep(station);
    }
  }

  // The street itself, between two junctions or from an end to one.
  void add_street(double from, double to) {
    plan_.roads.push_back({.kind = "tertiary",
                           .lanes = 2,
                           .width_m = kKerbToKerb,
                           .line = line_beside(*road_, from, to, 0)});
  }

  void finish(CityStreet& street) {
    landscape_.sort();
    street.landscape = std::move(landscape_);
    street.plan = std::move(plan_);
  }

 private:
  void keep(double station) { landscape_.place(station, fresh_); }

  void add_house(const Solid& walls) {
    fresh_.push_back(walls);
    plan_.houses.push_back(house_of(walls));
  }

  void add_kerb(double from, double to, double side) {
    for (const double station : stations(from, to, kKerbPiece)) {
      fresh_.push_back(box(Material::kKerb, road_->at(station + kKerbPiece / 2, side * kKerb),
                           kKerbPiece, kKerbWidth, 0, 0.12));
      keep(station);
    }
  }

  void add_parked_cars(double from, double to, double side) {
    const double share = random_.between(0.4, 0.9);
    for (const double station : stations(from + kSlot / 2, to - kSlot / 2, kSlot)) {
      if (!random_.chance(share)) {
        continue;
      }
      const double shift = random_.between(-0.4, 0.4);
      const double left = side * kParkingCentre + random_.between(-0.15, 0.15);
      const double askew = random_.between(-0.03, 0.03);
      const Placement at = road_->at(station + shift, left);
      add_car(some_car(random_), turned_by(at, side > 0 ? -1 : 1, askew), fresh_);
      keep(station);
    }
  }

  // Lamp posts and trees along the kerb, a few people who stand and talk.
  void add_pavement(double from, double to, double side) {
    for (const double station : stations(from + 4, to - 4, 13)) {
      const Placement at = road_->at(station + random_.between(-2, 2), side * (kKerb + 0.7));
      if (random_.chance(0.5)) {
        fresh_.push_back(cylinder(Material::kPole, at.x, at.y, 0.08, 0, 6));
      } else if (random_.chance(0.5)) {
        add_tree(at.x, at.y, random_, fresh_);
      }
      if (random_.chance(0.15)) {
        const Placement person = moved(at, 1.5, side * random_.between(0.5, 2.0));
        add_person(person.x, person.y, fresh_);
        add_person(person.x + 0.6, person.y + 0.3, fresh_);
      }
      keep(station);
    }
  }

  void add_buildings(double from, double to, double side) {
    double station = from;
    while (station < to - 6) {
      const double length = std::min(random_.between(10, 24), to - station);
      const double depth = random_.between(12, 30);
      const double front = random_.between(9.4, 11.5);
      const Placement at = road_->at(station + length / 2, side * (front + depth / 2));
      add_house(box(Material::kWall, at, length, depth, 0, random_.between(6, 18)));
      keep(station);
      station += length + (random_.chance(0.3) ? random_.between(3, 6) : 0.0);
    }
  }

  void add_park(double from, double to, double side) {
    double station = from + 2;
    while (station < to - 2) {
      const Placement at = road_->at(station, side * random_.between(10, 26));
      if (random_.chance(0.35)) {
        add_tree(at.x, at.y, random_, fresh_);
      } else {
        add_bush(at.x, at.y, random_, fresh_);
      }
      keep(station);
      station += random_.between(2, 6);
    }
  }

  const Road* road_;
  Random random_;
  std::vector<Solid> fresh_;  // of which the station is not noted yet
  Landscape landscape_;
  SitePlan plan_;
};

}  // namespace

CityStreet make_city_street(const Road& road, std::uint64_t seed, double drive_m) {
  Random random(seed, 1);
  Builder builder(road, seed);
  CityStreet street;
  double station = -kSight;
  double street_from = station;
  while (station < drive_m + kSight) {
    // The first block ends 45 m ahead of the start: every drive meets a junction early.
    const double length = street.junctions.empty() ? kSight + 45 : random.between(80, 150);
    builder.add_block(station, station + length);
    const double junction = station + length + kHalfJunction;
    builder.add_junction(junction);
    builder.add_street(street_from, junction);
    street_from = junction;
    street.junctions.push_back(junction);
    station = junction + kHalfJunction;
  }
  builder.finish(street);
  return street;
}

}  // namespace iog::tools
