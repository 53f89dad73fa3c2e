// The ground of a scene: what a ray meets is what small steps along it find.
#include "tools/simulate/world/terrain.hpp"

#include <cmath>

#include "gtest/gtest.h"

#include "tools/simulate/random.hpp"
#include "tools/simulate/scenes/hills.hpp"

namespace iog::tools {
namespace {

constexpr Course kBend{.radians_per_metre = 1.0 / 300, .swings = {{{0.1, 90}, {0, 100}}}};

const Scene& hills() {
  static const Scene scene = make_hills(4, 20);
  return scene;
}

// By steps of a centimetre; kNoHit if it is above ground all the way.
double first_dip(const Terrain& terrain, const Ray& ray, double farthest) {
  for (double distance = 0; distance < farthest; distance += 0.01) {
    const Vector3 at = point_at(ray, distance);
    if (at.z < terrain.height_at(at.x, at.y)) {
      return distance;
    }
  }
  return kNoHit;
}

TEST(RoadNearest, FindsThePlaceBesideTheRoad) {
  const Road road(kBend, -100, 300);
  for (double station = -50; station < 250; station += 12.3) {
    for (const double left : {-60.0, -3.0, 0.0, 4.5, 60.0}) {
      const Placement at = road.at(station, left);
      const Road::Place place = road.nearest(at.x, at.y);
      EXPECT_NEAR(place.station, station, 2e-3) << station << " " << left;
      EXPECT_NEAR(place.left, left, 2e-3) << station << " " << left;
    }
  }
}

TEST(Terrain, APlaneIsAPlane) {
  const Road road(kBend, -200, 400);
  const Terrain flat(road, [](double /*station*/, double /*left*/) { return 3.0; });
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double azimuth = random.between(-3.2, 3.2);
    const double elevation = random.between(-1.5, 0.2);
    const Ray ray{{random.between(-20, 20), random.between(-20, 20), 5},
                  {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation)}};
    const double expected = elevation < 0 ? -2 / ray.along.z : kNoHit;
    const double distance = flat.distance_to_ground(ray, 120);
    EXPECT_NEAR(distance, expected < 120 ? expected : kNoHit, 1e-9) << elevation;
  }
  EXPECT_EQ(flat.under({.x = 5, .y = 5}, 2, 1).z, 3);
  EXPECT_NEAR(flat.under({.x = 5, .y = 5}, 2, 1).along, 0, 1e-12);
}

TEST(Terrain, ARayMeetsTheGroundWhereItFirstDipsBelow) {
  const Terrain& terrain = *hills().terrain;
  Random random(2);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const double azimuth = random.between(-3.2, 3.2);
    const double elevation = random.between(-0.35, 0.05);
    const Placement from = hills().road.at(random.between(-20, 160), random.between(-12, 10));
    const Ray ray{{from.x, from.y, terrain.height_at(from.x, from.y) + 1.9},
                  {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation)}};
    const double expected = first_dip(terrain, ray, 80);
    const double distance = terrain.distance_to_ground(ray, 80);
    if (distance < kNoHit) {
      const Vector3 at = point_at(ray, distance);
      EXPECT_NEAR(at.z, terrain.height_at(at.x, at.y), 1e-6) << i;
    }
    // It may graze a tuft between two steps.
    EXPECT_LT(distance, expected == kNoHit ? 2 * kNoHit : expected + 1e-6) << i;
    met += std::abs(distance - expected) < 0.0101 ? 1 : 0;
  }
  EXPECT_GT(met, 290);
}

TEST(Terrain, ThingsLieAsTheGroundSlopes) {
  const Road road(Course{.swings = {{{0, 100}, {0, 100}}}}, 0, 100);
  const Terrain slope(road,
                      [](double station, double left) { return 0.1 * station + 0.02 * left; });
  std::vector<Solid> car{
      box(Material::kCar, {.x = 10, .y = 2, .cos = 0, .sin = 1}, 4, 1.8, 0.2, 1),
      box(Material::kCar, {.x = 10, .y = 1, .cos = 0, .sin = 1}, 2, 1.6, 1, 1.5)};
  slope.put(car);
  // It points to the left of the road: the road's slope is to its right.
  EXPECT_NEAR(car[0].footing.z, 1.04, 1e-9);
  EXPECT_NEAR(car[0].footing.along, 0.02, 1e-9);
  EXPECT_NEAR(car[0].footing.left, -0.1, 1e-9);
  EXPECT_NEAR(car[1].footing.z, 1.02, 1e-9);
  // From above onto its bonnet, 0.5 m to its right, which is uphill.
  EXPECT_NEAR(distance_to(car[0], {{10.5, 2.9, 9}, {0, 0, -1}}), 9 - (1 + 1.05 + 0.058), 1e-9);
  std::vector<Solid> pole{cylinder(Material::kPole, 20, 0, 0.1, 0, 3)};
  slope.put(pole);
  EXPECT_NEAR(pole[0].footing.z, 2, 1e-9);
  EXPECT_EQ(pole[0].footing.along, 0);
}

}  // namespace
}  // namespace iog::tools
