// What ground a place has, held against how the scene drives, walks and stands on it.
#include "tools/simulate/truth/true_ground.hpp"

#include <algorithm>
#include <cmath>

#include "gtest/gtest.h"

#include "tools/simulate/random.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"

namespace iog::tools {
namespace {

constexpr double kDriveS = 10;

class GroundOfEveryScene : public testing::TestWithParam<SceneEntry> {
 protected:
  Scene scene_ = GetParam().make(1, kDriveS);
  TrueGround ground_{scene_.plan};
};

INSTANTIATE_TEST_SUITE_P(Scenes, GroundOfEveryScene, testing::ValuesIn(all_scenes()),
                         [](const auto& entry) { return std::string(entry.param.name); });

TEST_P(GroundOfEveryScene, TheCarIsOnTheRoad) {
  for (double time_s = 0; time_s <= kDriveS; time_s += 0.1) {
    const Placement car = scene_.ego_at(time_s).at;
    for (const double left : {-0.9, 0.9}) {
      const Placement wheel = moved(car, 0, left);
      EXPECT_EQ(ground_.at(wheel.x, wheel.y), Ground::kRoad);
    }
  }
}

TEST_P(GroundOfEveryScene, EveryHouseStandsOnItsOwn) {
  for (const PlannedHouse& house : scene_.plan.houses) {
    for (const double share : {-0.999, 0.0, 0.999}) {
      const Placement inside =
          moved(house.at, share * house.half_length_m, share * house.half_width_m);
      EXPECT_EQ(ground_.at(inside.x, inside.y), Ground::kHouse);
    }
  }
}

// A point is of a road if its distance to one of the road's pieces, seen from the side, is below
// half its width. Within 5 cm of a border nobody is asked, nor around the ends.
TEST_P(GroundOfEveryScene, IsThatOfBruteForce) {
  constexpr double kMargin = 0.05;
  Random random(9);
  std::size_t asked = 0;
  std::size_t on_road = 0;
  for (int i = 0; i < 4'000; ++i) {
    const Placement car = scene_.ego_at(random.between(0, kDriveS)).at;
    const double forward = random.between(-60, 60);
    const double left = random.between(-60, 60);
    const Placement at = moved(car, forward, left);
    double deepest = -1e9;
    bool is_at_end = false;
    for (const PlannedRoad& road : scene_.plan.roads) {
      for (std::size_t piece = 1; piece < road.line.size(); ++piece) {
        const Placement& a = road.line[piece - 1];
        const Placement& b = road.line[piece];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        const double along = ((at.x - a.x) * (b.x - a.x) + (at.y - a.y) * (b.y - a.y)) / length;
        const double beside = ((b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x)) / length;
        const double depth = road.width_m / 2 - std::abs(beside);
        // Pieces are wedges in a curve: up to a tenth of their length longer or shorter outside.
        if (along >= 0 && along <= length) {
          deepest = std::max(deepest, depth);
        }
        is_at_end = is_at_end ||
                    (depth > -kMargin && (std::abs(along) < 0.3 || std::abs(along - length) < 0.3));
      }
    }
    const bool is_house = std::ranges::any_of(scene_.plan.houses, [&at](const auto& house) {
      return covers(
          box(Material::kWall, house.at, 2 * house.half_length_m, 2 * house.half_width_m, 0, 1),
          at.x, at.y);
    });
    if (is_house) {
      EXPECT_EQ(ground_.at(at.x, at.y), Ground::kHouse);
    } else if (std::abs(deepest) > kMargin && !is_at_end) {
      EXPECT_EQ(ground_.at(at.x, at.y), deepest > 0 ? Ground::kRoad : Ground::kBeside);
      ++asked;
      on_road += deepest > 0 ? 1U : 0U;
    }
  }
  EXPECT_GT(asked, 1'500U);
  EXPECT_GT(on_road, 200U);
}

// Where the kerbs of the city are, the road ends: 8 cm before their middle and not before.
TEST(TrueGround, EndsAtTheKerb) {
  const Scene scene = find_scene("city").make(1, kDriveS);
  const TrueGround ground(scene.plan);
  std::vector<Solid> solids;
  scene.append_seen_at(0, solids);
  std::size_t kerbs = 0;
  for (const Solid& solid : solids) {
    if (solid.material == Material::kKerb) {
      const Placement one_side = moved(solid.at, 0, 0.2);
      const Placement other_side = moved(solid.at, 0, -0.2);
      EXPECT_NE(ground.at(one_side.x, one_side.y) == Ground::kRoad,
                ground.at(other_side.x, other_side.y) == Ground::kRoad);
      ++kerbs;
    }
  }
  EXPECT_GT(kerbs, 100U);
}

// Cars stand on roads and people walk beside them, but for cars behind the house at a street's end
// and people who cross a street.
TEST(TrueGround, IsWhatTheStreetIsUsedFor) {
  const Scene scene = find_scene("city").make(1, kDriveS);
  const TrueGround ground(scene.plan);
  for (double time_s = 0; time_s < kDriveS; time_s += 2.5) {
    std::vector<Solid> solids;
    scene.append_seen_at(time_s, solids);
    std::size_t cars = 0;
    std::size_t people = 0;
    std::size_t cars_on_road = 0;
    std::size_t people_beside = 0;
    for (const Solid& solid : solids) {
      const Ground under = ground.at(solid.at.x, solid.at.y);
      if (solid.material == Material::kCar) {
        ++cars;
        cars_on_road += under == Ground::kRoad ? 1U : 0U;
      } else if (solid.material == Material::kPerson) {
        ++people;
        people_beside += under == Ground::kBeside ? 1U : 0U;
      }
    }
    EXPECT_GT(cars, 20U);
    EXPECT_GT(cars_on_road * 10, cars * 9);
    EXPECT_GT(people, 5U);
    EXPECT_GT(people_beside * 10, people * 8);
  }
}

TEST(TrueGround, CellsAreAskedAtTheirCentres) {
  SitePlan plan;
  plan.houses = {{.at = {.x = 1.0, .y = 2.0}, .half_length_m = 0.3, .half_width_m = 0.2}};
  const std::vector<Ground> cells =
      true_ground(TrueGround(plan), {.x = 5, .y = 15, .width = 10, .height = 10});
  for (std::size_t y = 0; y < 10; ++y) {
    for (std::size_t x = 0; x < 10; ++x) {
      const bool is_in = x >= 2 && x < 8 && y >= 3 && y < 7;
      EXPECT_EQ(cells[y * 10 + x], is_in ? Ground::kHouse : Ground::kBeside) << x << ' ' << y;
    }
  }
  EXPECT_EQ(TrueGround(SitePlan{}).at(0, 0), Ground::kBeside);
}

}  // namespace
}  // namespace iog::tools
