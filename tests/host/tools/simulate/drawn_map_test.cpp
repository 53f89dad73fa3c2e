// Each error of a drawn map does what it says, and nothing else.
#include "tools/simulate/maps/drawn_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gtest/gtest.h"

#include "tools/program/exit_status.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"
#include "tools/simulate/truth/true_ground.hpp"

namespace iog::tools {
namespace {

constexpr double kDriveS = 10;

const Scene& city() {
  static const Scene the_city = find_scene("city").make(2, kDriveS);
  return the_city;
}

DrawnMap drawn(const MapErrors& errors, std::uint64_t seed = 1) {
  return drawn_map(city(), errors, seed, kDriveS);
}

bool is_same(const PlannedHouse& a, const PlannedHouse& b) {
  return a.at.x == b.at.x && a.at.y == b.at.y && a.at.cos == b.at.cos && a.at.sin == b.at.sin &&
         a.half_length_m == b.half_length_m && a.half_width_m == b.half_width_m;
}

std::size_t as_planned(const DrawnMap& map) {
  return static_cast<std::size_t>(std::ranges::count_if(map.houses, [](const DrawnHouse& drawn) {
    return std::ranges::any_of(city().plan.houses, [&drawn](const PlannedHouse& house) {
      return is_same(house, drawn.house);
    });
  }));
}

std::size_t count_of(const DrawnMap& map, HouseDrawn how) {
  return static_cast<std::size_t>(std::ranges::count(map.houses, how, &DrawnHouse::how));
}

std::size_t roads_without_width(const DrawnMap& map) {
  return static_cast<std::size_t>(std::ranges::count(map.roads, false, &DrawnRoad::has_width));
}

TEST(DrawnMap, WithoutErrorsIsThePlan) {
  const DrawnMap map = drawn({});
  EXPECT_EQ(map.houses.size(), city().plan.houses.size());
  EXPECT_EQ(as_planned(map), city().plan.houses.size());
  EXPECT_EQ(map.roads.size(), city().plan.roads.size());
  EXPECT_EQ(roads_without_width(map), 0U);
  EXPECT_TRUE(map.missing.empty());
}

TEST(DrawnMap, SharesAreMetToTheNearestHouse) {
  const auto houses = static_cast<double>(city().plan.houses.size());
  for (const double share : {0.0, 0.1, 0.37, 0.5, 1.0}) {
    const auto wanted = static_cast<std::size_t>(std::lround(share * houses));
    const DrawnMap missing = drawn({.missing = share});
    EXPECT_EQ(missing.missing.size(), wanted);
    EXPECT_EQ(as_planned(missing), city().plan.houses.size() - wanted);
    EXPECT_EQ(missing.houses.size(), city().plan.houses.size() - wanted);
    const DrawnMap outdated = drawn({.outdated = share});
    EXPECT_EQ(count_of(outdated, HouseDrawn::kOutdated), wanted);
    EXPECT_EQ(as_planned(outdated), city().plan.houses.size() - wanted);
    const DrawnMap bare = drawn({.no_width = share});
    EXPECT_EQ(
        roads_without_width(bare),
        static_cast<std::size_t>(std::lround(share * static_cast<double>(bare.roads.size()))));
  }
}

TEST(DrawnMap, AnOutdatedHouseIsNearItsOwn) {
  const DrawnMap map = drawn({.outdated = 1});
  for (std::size_t i = 0; i < map.houses.size(); ++i) {
    const PlannedHouse& was = city().plan.houses[i];
    const PlannedHouse& is = map.houses[i].house;
    EXPECT_LE(std::abs(is.at.x - was.at.x), 2);
    EXPECT_LE(std::abs(is.at.y - was.at.y), 2);
    for (const double scale :
         {is.half_length_m / was.half_length_m, is.half_width_m / was.half_width_m}) {
      EXPECT_GE(scale, 0.6);
      EXPECT_LE(scale, 1.4);
    }
  }
}

// Of 20 maps with some 40 houses each, two axes: the deviation is known to 2 %, four times that is
// allowed.
TEST(DrawnMap, NoiseHasItsDeviation) {
  constexpr double kNoise = 0.8;
  double squares = 0;
  double sum = 0;
  double count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const DrawnMap map = drawn({.noise_m = kNoise}, seed);
    for (std::size_t i = 0; i < map.houses.size(); ++i) {
      const PlannedHouse& was = city().plan.houses[i];
      const PlannedHouse& is = map.houses[i].house;
      EXPECT_EQ(is.half_length_m, was.half_length_m);
      EXPECT_EQ(is.at.cos, was.at.cos);
      for (const double error : {is.at.x - was.at.x, is.at.y - was.at.y}) {
        squares += error * error;
        sum += error;
        ++count;
      }
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), kNoise, 0.08 * kNoise);
  EXPECT_NEAR(sum / count, 0, 4 * kNoise / std::sqrt(count));
}

// The 0.5 m grid of points in the outline, its border included.
std::vector<Placement> points_in(const PlannedHouse& house) {
  std::vector<Placement> points;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      points.push_back(
          moved(house.at, house.half_length_m * (i - 10) / 10, house.half_width_m * (j - 10) / 10));
    }
  }
  return points;
}

TEST(DrawnMap, GhostsStandInTurnOnFreeGroundAndOnRoads) {
  for (const SceneEntry& entry : all_scenes()) {
    const Scene scene = entry.make(4, kDriveS);
    const TrueGround ground(scene.plan);
    const DrawnMap map = drawn_map(scene, {.ghosts = 9}, 1, kDriveS);
    ASSERT_EQ(map.houses.size(), scene.plan.houses.size() + 9);
    EXPECT_EQ(count_of(map, HouseDrawn::kGhostBeside), 5U);
    EXPECT_EQ(count_of(map, HouseDrawn::kGhostOnRoad), 4U);
    for (const DrawnHouse& drawn : map.houses) {
      const Placement& at = drawn.house.at;
      if (drawn.how == HouseDrawn::kGhostBeside) {
        for (const Placement& point : points_in(drawn.house)) {
          EXPECT_EQ(ground.at(point.x, point.y), Ground::kBeside) << entry.name;
        }
      } else if (drawn.how == HouseDrawn::kGhostOnRoad) {
        EXPECT_TRUE(std::ranges::any_of(scene.plan.roads, [&at](const PlannedRoad& road) {
          return std::ranges::any_of(road.line, [&at](const Placement& point) {
            return point.x == at.x && point.y == at.y;
          });
        }));
      }
      double nearest = 1e9;
      for (double time_s = 0; time_s <= kDriveS; time_s += 0.1) {
        const Placement car = scene.ego_at(time_s).at;
        nearest = std::min(nearest, std::hypot(car.x - at.x, car.y - at.y));
      }
      EXPECT_TRUE(nearest <= 40 || drawn.how == HouseDrawn::kAsItIs);
    }
  }
}

// Noise moves the same houses by as much whatever else is wrong.
TEST(DrawnMap, ErrorsDoNotStirEachOther) {
  const DrawnMap alone = drawn({.missing = 0.3});
  const DrawnMap together =
      drawn({.noise_m = 1, .missing = 0.3, .ghosts = 4, .outdated = 0.2, .no_width = 0.5});
  ASSERT_EQ(alone.missing.size(), together.missing.size());
  for (std::size_t i = 0; i < alone.missing.size(); ++i) {
    EXPECT_TRUE(is_same(alone.missing[i], together.missing[i]));
  }
}

TEST(DrawnMap, WhereEverythingIsBuiltThereIsNoGhost) {
  Scene scene = city();
  scene.plan.houses = {{.at = {}, .half_length_m = 1e4, .half_width_m = 1e4}};
  EXPECT_THROW(static_cast<void>(drawn_map(scene, {.ghosts = 1}, 1, kDriveS)), UsageError);
}

}  // namespace
}  // namespace iog::tools
