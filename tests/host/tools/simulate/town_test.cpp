// A scene that is made of a map. What is expected is said in metres of the plane, and where they
// are on the earth by the plane itself.
#include "tools/simulate/scenes/town.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "gtest/gtest.h"

#include "map/block.hpp"
#include "tools/map/map_maker.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/simulate/scenes/town_route.hpp"

namespace iog::tools {
namespace {

constexpr MapOrigin kOrigin{.latitude = 48'410'000'000, .longitude = 15'600'000'000};
constexpr double kDriveS = 10;

GeoPoint at(double east, double north) {
  const Geodetic place = kOrigin.plane().geodetic_of({east, north});
  return {place.latitude, place.longitude};
}

GeoRoad road(const std::vector<LocalPlane::Place>& line, double width = 7) {
  GeoRoad road{.width_m = width};
  for (const LocalPlane::Place& place : line) {
    road.line.push_back(at(place.east_m, place.north_m));
  }
  return road;
}

GeoArea house(double west, double south, double east, double north) {
  return {.rings = {{at(west, south), at(east, south), at(east, north), at(west, north)}}};
}

GeoMap map_of(std::vector<GeoRoad> roads, std::vector<GeoArea> areas = {}) {
  GeoMap map{.source = map::Source::kOpenStreetMap, .attribution = "us"};
  map.roads = std::move(roads);
  map.areas = std::move(areas);
  for (const GeoRoad& road : map.roads) {
    for (const GeoPoint& point : road.line) {
      map.box.extend(point);
    }
  }
  for (const GeoArea& area : map.areas) {
    for (const GeoPoint& point : area.rings[0]) {
      map.box.extend(point);
    }
  }
  return map;
}

// A road to the east that turns to the north, in two ways, with a side road that turns back.
GeoMap corner_town(std::vector<GeoArea> areas = {}) {
  return map_of({road({{-80, 0}, {60, 0}}), road({{60, 0}, {60, 200}}), road({{60, 0}, {50, -9}})},
                std::move(areas));
}

double from_corner_road(const Road::Point& point) {
  const double east_part = point.x > 60 ? std::hypot(point.x - 60, point.y) : std::abs(point.y);
  const double north_part =
      point.y < 0 ? std::hypot(point.x - 60, point.y) : std::abs(point.x - 60);
  return std::min(east_part, north_part);
}

TEST(TownRoute, FollowsTheRoadAndTakesTheCorner) {
  const TownRoute route =
      town_route(map_of({road({{-80, 0}, {60, 0}, {60, 300}})}), kOrigin, 250, 60);
  EXPECT_EQ(route.width_m, 7);
  EXPECT_NEAR(route.points[route.start].x, 0, 0.3) << "nearest to the origin";
  EXPECT_NEAR(route.points[route.start].y, 0, 0.01);
  double farthest = 0;
  for (std::size_t i = 1; i < route.points.size(); ++i) {
    const Road::Point& a = route.points[i - 1];
    const Road::Point& b = route.points[i];
    EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), Road::kStep, 1e-2);
    if (b.x > -80 && b.y < 300) {
      farthest = std::max(farthest, from_corner_road(b));
    }
  }
  EXPECT_LT(farthest, 4) << "a corner of 90 degrees is cut by less than a lane and a half";
  EXPECT_GT(farthest, 1) << "it is cut";
}

// The side road is not so straight, and a road that only crosses in the picture is not met.
TEST(TownRoute, GoesOnWhereItTurnsLeast) {
  const TownRoute route =
      town_route(map_of({road({{-10, 0}, {50, 0}}), road({{50, 0}, {90, 40}}),
                         road({{50, 0}, {250, 20}}), road({{30, -50}, {30, 400}})}),
                 kOrigin, 200, 0);
  EXPECT_TRUE(std::ranges::any_of(route.points, [](const Road::Point& point) {
    return std::abs(point.x - 200) < 0.5 && std::abs(point.y - 15) < 0.1;
  }));
}

TEST(TownRoute, TurnsRoundIfOnlyTheOtherDirectionIsLongEnough) {
  const TownRoute route = town_route(map_of({road({{-300, 0}, {20, 0}})}), kOrigin, 200, 60);
  EXPECT_LT(route.points[route.start + 100].x, -49);
}

TEST(TownRoute, SaysWhyThereIsNone) {
  EXPECT_THROW(static_cast<void>(town_route(map_of({}), kOrigin, 100, 60)), UsageError);
  EXPECT_THROW(
      static_cast<void>(town_route(map_of({road({{600, 0}, {900, 0}})}), kOrigin, 100, 60)),
      UsageError)
      << "too far from the origin";
  try {
    static_cast<void>(town_route(corner_town(), kOrigin, 400, 60));
    FAIL() << "the roads are shorter than that";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find(" 260 m far, and the drive needs 401"),
              std::string::npos)
        << error.what();
  }
  const auto twice = road({{0, 0}, {0, 0}, {40, 0}});
  EXPECT_THROW(static_cast<void>(town_route(map_of({twice}), kOrigin, 100, 60)), UsageError)
      << "a place twice is no way";
}

TEST(TownRoute, DoesNotGoInCircles) {
  const GeoMap square =
      map_of({road({{0, 0}, {30, 5}, {50, 30}, {45, 60}, {20, 80}, {-5, 60}, {-15, 30}, {0, 0}})});
  EXPECT_THROW(static_cast<void>(town_route(square, kOrigin, 400, 60)), UsageError);
}

// The houses of the scene are those of the block that iog map makes of the same data.
TEST(Town, WallsStandWhereTheMapHasThem) {
  GeoMap source = map_of({road({{-80, 0}, {300, 30}})},
                         {house(10, 12, 30, 25), house(60, -40, 75, -10), house(0, 900, 9, 910)});
  const Town town = make_town(source, kOrigin, 1, kDriveS);
  const MadeMap made = make_block(source, {.origin = kOrigin});
  ASSERT_EQ(map::check(made.block), map::Refusal::kNone);
  EXPECT_EQ(town.walls, 8U) << "the third house is out of sight";
  EXPECT_EQ(town.walls_in_the_way, 0U);
  std::set<std::pair<long, long>> corners;  // centimetres
  const map::Block block(made.block);
  for (std::uint32_t i = 0; i < block.feature_count(); ++i) {
    const map::Feature feature = block.feature(i);
    if (feature.kind() == map::Kind::kBuilding) {
      feature.for_each_edge(
          [&](map::PointCm from, map::PointCm) { corners.emplace(from.x, from.y); });
    }
  }
  const pose::Pose frame = town.place.local_frame;
  EXPECT_EQ(frame.heading, 0U);
  std::vector<Solid> solids;
  town.scene.landscape.append_seen_from(0, solids);
  int walls = 0;
  for (const Solid& wall : solids) {
    if (wall.material != Material::kWall) {
      continue;
    }
    ++walls;
    for (const double end : {-1.0, 1.0}) {
      const double reach = end * (wall.half_length - wall.half_width);
      const double x_cm = (wall.at.x + reach * wall.at.cos) * 100 + frame.x_mm / 10.0;
      const double y_cm = (wall.at.y + reach * wall.at.sin) * 100 + frame.y_mm / 10.0;
      EXPECT_TRUE(std::ranges::any_of(corners,
                                      [&](const auto& corner) {
                                        return std::hypot(
                                                   static_cast<double>(corner.first) - x_cm,
                                                   static_cast<double>(corner.second) - y_cm) < 1.5;
                                      }))
          << x_cm << ' ' << y_cm;
    }
  }
  EXPECT_EQ(walls, 8);
}

// Where a road is wider than the gap between two houses, walls would stand in the lanes.
TEST(Town, TheWayIsClear) {
  const Town town =
      make_town(corner_town({house(20, 1, 40, 9), house(48, 8, 52, 30), house(64.5, 20, 70, 60)}),
                kOrigin, 2, kDriveS);
  EXPECT_EQ(town.walls_in_the_way, 3U) << "of the first house: three walls reach into the road";
  for (double time_s = 0; time_s < kDriveS; time_s += 0.5) {
    std::vector<Solid> solids;
    town.scene.append_seen_at(time_s, solids);
    const Placement ego = town.scene.ego_at(time_s).at;
    for (const double left : {-0.9, 0.0, 0.9}) {
      const Placement place = moved(ego, 2, left);
      EXPECT_TRUE(std::ranges::none_of(solids, [&](const Solid& solid) {
        return solid.z_low < 2 && covers(solid, place.x, place.y);
      })) << time_s;
    }
  }
}

TEST(Town, TheCarPointsWhereItGoesAndKeepsToTheRight) {
  const Town town = make_town(corner_town(), kOrigin, 3, kDriveS);
  for (double time_s = 1; time_s < kDriveS; time_s += 0.2) {
    const Placement before = town.scene.ego_at(time_s - 0.1).at;
    const Placement now = town.scene.ego_at(time_s).at;
    const Placement after = town.scene.ego_at(time_s + 0.1).at;
    const double x = after.x - before.x;
    const double y = after.y - before.y;
    const double way = std::hypot(x, y);
    EXPECT_NEAR(now.cos, x / way, 2e-2) << time_s;
    EXPECT_NEAR(now.sin, y / way, 2e-2) << time_s;
  }
  EXPECT_NEAR(town.scene.ego_at(0).at.y, -7.0 / 4, 0.2);
}

TEST(Town, WithoutAnOriginBeginsInTheMiddle) {
  const GeoMap map = map_of({road({{-400, 0}, {400, 0}})});
  const Town town = make_town(map, std::nullopt, 1, kDriveS);
  EXPECT_EQ(town.place.origin, middle_of(map));
}

TEST(Town, TheSameMapAndSeedMakeTheSameTown) {
  const auto solids_of = [](std::uint64_t seed) {
    std::vector<Solid> solids;
    make_town(corner_town({house(20, 10, 40, 20)}), kOrigin, seed, kDriveS)
        .scene.append_seen_at(3, solids);
    std::vector<double> numbers;
    for (const Solid& solid : solids) {
      numbers.insert(numbers.end(), {solid.at.x, solid.at.y, solid.z_high});
    }
    return numbers;
  };
  EXPECT_EQ(solids_of(5), solids_of(5));
  EXPECT_NE(solids_of(5), solids_of(6));
}

}  // namespace
}  // namespace iog::tools
