#include "tools/simulate/scenes/ring_road_verge.hpp"

#include <cstddef>
#include <utility>

#include "tools/simulate/random.hpp"
#include "tools/simulate/world/street_furniture.hpp"

namespace iog::tools {
namespace {

// Metres from the centre line.
constexpr double kInnerRail = 1.2;
constexpr double kOuterRail = 16.5;
constexpr double kGantryPost = kOuterRail + 1.2;

constexpr double kRailPiece = 4.0;  // from post to post
constexpr double kBarrierPiece = 4.0;
constexpr double kBankPiece = 6.0;
// By so much a piece is longer than its share of the centre line: on the outside of a curve they
// would stand apart.
constexpr double kOverlap = 1.14;

constexpr double kLampDistance = 45;
constexpr double kMarkerDistance = 50;
constexpr double kHouseDistance = 20;
constexpr double kGantryDistance = 430;
constexpr std::array kSides{1.0, -1.0};

// What lies beside the road, one stretch after another.
enum class Land : std::uint8_t { kOpen, kBarrier, kBank };
constexpr std::array kLand{Land::kOpen, Land::kBarrier, Land::kOpen, Land::kBank};

// Builds piece by piece and remembers at which station each piece stands.
class Builder {
 public:
  Builder(const Road& road, std::uint64_t seed) : road_(&road), random_(seed, 4) {}

  void add_reservation(double from, double to) {
    for (const double side : kSides) {
      add_rail(from, to, side * kInnerRail);
    }
    for (const double station : stations(from, to, kLampDistance)) {
      const Placement at = road_->at(station, 0);
      fresh_.push_back(cylinder(Material::kPole, at.x, at.y, 0.12, 0, 10));
      keep(station);
    }
  }

  // Every drive begins among the same kinds of land, the left side one ahead of the right, so that
  // the load of a short drive does not hang on its seed.
  void add_verge(double from, double to, double side) {
    add_marker_posts(from, to, side * (kOuterRail + 0.5));
    std::size_t stretch = side > 0 ? 1 : 0;
    double station = from;
    while (station < to) {
      const double end = station + random_.between(90, 130);
      add_land(kLand[stretch % kLand.size()], station, end, side);
      station = end;
      ++stretch;
    }
  }

  // Three posts, behind guard rails, and what they carry, well above every beam.
  void add_gantry(double station) {
    for (const double left : {-kGantryPost, 0.0, kGantryPost}) {
      fresh_.push_back(box(Material::kPole, road_->at(station, left), 0.5, 0.5, 0, 7));
    }
    fresh_.push_back(box(Material::kPole, road_->at(station, 0), 0.6, 2 * kGantryPost, 5.5, 7));
    keep(station);
    for (const double side : kSides) {
      add_rail(station - 30, station + 30, side * kOuterRail);
    }
  }

  [[nodiscard]] RingRoadVerge take() {
    landscape_.sort();
    return {std::move(landscape_), std::move(houses_)};
  }

 private:
  void keep(double station) { landscape_.place(station, fresh_); }

  void add_land(Land land, double from, double to, double side) {
    switch (land) {
      case Land::kOpen:
        add_open_land(from, to, side);
        break;
      case Land::kBarrier:
        add_barrier(from, to, side);
        break;
      case Land::kBank:
        add_bank(from, to, side);
        break;
    }
  }

  // A beam of steel at the height of a bumper, on posts.
  void add_rail(double from, double to, double left) {
    for (const double station : stations(from, to, kRailPiece)) {
      fresh_.push_back(box(Material::kRail, road_->at(station + kRailPiece / 2, left),
                           kOverlap * kRailPiece, 0.12, 0.44, 0.75));
      fresh_.push_back(box(Material::kRail, road_->at(station, left), 0.10, 0.06, 0, 0.75));
      keep(station);
    }
  }

  void add_marker_posts(double from, double to, double left) {
    for (const double station : stations(from, to, kMarkerDistance)) {
      const Placement at = road_->at(station, left);
      fresh_.push_back(cylinder(Material::kPole, at.x, at.y, 0.06, 0, 1.0));
      keep(station);
    }
  }

  // A wall against noise.
  void add_barrier(double from, double to, double side) {
    const double left = side * (kOuterRail + random_.between(14, 22));
    const double height = random_.between(3, 5);
    for (const double station : stations(from, to, kBarrierPiece)) {
      fresh_.push_back(box(Material::kWall, road_->at(station + kBarrierPiece / 2, left),
                           kOverlap * kBarrierPiece, 0.2, 0, height));
      keep(station);
    }
  }

  // Terraces of half a metre stand for a slope of 1 in 2.
  void add_bank(double from, double to, double side) {
    constexpr double kTerrace = 1.0;
    const double foot = kOuterRail + random_.between(14, 22);
    const auto terraces = 3 + random_.below(4);
    const double top = foot + kTerrace * static_cast<double>(terraces) + 3;
    for (const double station : stations(from, to, kBankPiece)) {
      for (std::size_t i = 0; i < terraces; ++i) {
        const double edge = foot + kTerrace * static_cast<double>(i);
        const double height = kTerrace / 2 * static_cast<double>(i + 1);
        const Placement at = road_->at(station + kBankPiece / 2, side * (edge + top) / 2);
        fresh_.push_back(box(Material::kBank, at, kOverlap * kBankPiece, top - edge, 0, height));
      }
      keep(station);
    }
  }

  // Trees and bushes far apart, and houses beyond them.
  void add_open_land(double from, double to, double side) {
    double station = from;
    while (station < to) {
      const Placement at = road_->at(station, side * (kOuterRail + random_.between(4, 40)));
      if (random_.chance(0.5)) {
        add_tree(at.x, at.y, random_, fresh_);
      } else {
        add_bush(at.x, at.y, random_, fresh_);
      }
      keep(station);
      station += random_.between(8, 25);
    }
    for (const double house : stations(from, to, kHouseDistance)) {
      const Placement at = road_->at(house, side * (kOuterRail + random_.between(30, 65)));
      fresh_.push_back(box(Material::kWall, at, 18, 14, 0, 8));
      houses_.push_back(house_of(fresh_.back()));
      keep(house);
    }
  }

  const Road* road_;
  Random random_;
  std::vector<Solid> fresh_;  // of which the station is not noted yet
  Landscape landscape_;
  std::vector<PlannedHouse> houses_;
};

}  // namespace

RingRoadVerge make_ring_road_verge(const Road& road, std::uint64_t seed, double drive_m) {
  Builder builder(road, seed);
  const double from = -kSight - 60;
  const double to = drive_m + kSight + 60;
  builder.add_reservation(from, to);
  for (const double side : kSides) {
    builder.add_verge(from, to, side);
  }
  for (const double station : stations(from + 90, to, kGantryDistance)) {
    builder.add_gantry(station);
  }
  return builder.take();
}

}  // namespace iog::tools
