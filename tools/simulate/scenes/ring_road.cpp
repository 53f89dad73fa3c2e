#include "tools/simulate/scenes/ring_road.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "tools/simulate/random.hpp"
#include "tools/simulate/scenes/ring_road_verge.hpp"

namespace iog::tools {
namespace {

// Once round in 15.7 km, with curves of down to 300 m radius:
// 1 / 2500 + 0.25 * 2 pi / 900 + 0.08 * 2 pi / 430.
constexpr Course kCourse{
    .radians_per_metre = 1.0 / 2500,
    .swings = {{{.radians = 0.25, .wavelength = 900}, {.radians = 0.08, .wavelength = 430}}}};

constexpr std::size_t kSlowLane = 2;
constexpr double kOwnLane = -kRingRoadLanes[kSlowLane];

// Between 23 and 27 m/s.
constexpr Cruise kCruise{
    .mean_speed = 25.0, .speed_swing = 2.0, .swing_period = 37.0, .left = kOwnLane};

// From the fast lane to the slow one.
constexpr std::array kLaneSpeeds{33.0, 29.0, 25.0};
constexpr double kNearest = 90;  // between two cars of one lane
constexpr double kFarthest = 250;

CarShape some_vehicle(std::size_t lane, Random& random) {
  return lane == kSlowLane && random.chance(0.4) ? kLorry : some_car(random);
}

// Fills a lane so that cars come into sight for as long as the drive lasts. direction: 1 or -1.
void add_lane(std::size_t lane, double direction, double drive_s, Random& random,
              Traffic& traffic) {
  const double speed = direction * kLaneSpeeds[lane];
  const double passed = kCruise.station_at(drive_s) - speed * drive_s;
  const double end = kSight + std::max(passed, 0.0);
  double station = std::min(passed, 0.0) - kSight + random.between(0, kFarthest);
  while (station < end) {
    traffic.cars.push_back({.station = station,
                            .left = -direction * kRingRoadLanes[lane],
                            .speed = speed,
                            .shape = some_vehicle(lane, random)});
    station += random.between(kNearest, kFarthest);
  }
}

Traffic make_traffic(std::uint64_t seed, double drive_s) {
  Random random(seed, 5);
  Traffic traffic;
  traffic.companions.push_back(
      {.ahead = 65, .swing = 10, .swing_period = 29, .left = kOwnLane, .shape = some_car(random)});
  traffic.companions.push_back(
      {.ahead = -50, .swing = 8, .swing_period = 23, .left = kOwnLane, .shape = some_car(random)});
  for (std::size_t lane = 0; lane < kRingRoadLanes.size(); ++lane) {
    add_lane(lane, -1, drive_s, random, traffic);
    if (-kRingRoadLanes[lane] != kOwnLane) {
      add_lane(lane, 1, drive_s, random, traffic);
    }
  }
  return traffic;
}

// Pieces of some hundred metres, as maps have them.
std::vector<PlannedRoad> make_carriageways(const Road& road, double from, double to) {
  constexpr double kPiece = 200;
  std::vector<PlannedRoad> roads;
  for (const double station : stations(from, to, kPiece)) {
    const double end = std::min(station + kPiece, to);
    for (const double side : {1.0, -1.0}) {
      roads.push_back({.kind = "trunk",
                       .lanes = kRingRoadLanes.size(),
                       .is_oneway = true,
                       .width_m = kCarriagewayWidth,
                       .line = line_beside(road, station, end, side * kCarriagewayMiddle)});
      if (side > 0) {
        std::ranges::reverse(roads.back().line);
      }
    }
  }
  return roads;
}

}  // namespace

Scene make_ring_road(std::uint64_t seed, double drive_s) {
  const double drive_m = kCruise.station_at(drive_s);
  const Road road(kCourse, -2 * kSight, drive_m + 2 * kSight);
  RingRoadVerge verge = make_ring_road_verge(road, seed, drive_m);
  SitePlan plan{.roads = make_carriageways(road, -kSight, drive_m + kSight),
                .houses = std::move(verge.houses)};
  return {road, kCruise, std::move(verge.landscape), make_traffic(seed, drive_s), std::move(plan)};
}

}  // namespace iog::tools
