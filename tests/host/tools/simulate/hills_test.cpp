// The hills have what their header says.
#include "tools/simulate/scenes/hills.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gtest/gtest.h"

#include "tools/simulate/scanners/ray_caster.hpp"
#include "tools/simulate/scenes/hills_ground.hpp"
#include "tools/simulate/world/street_furniture.hpp"

namespace iog::tools {
namespace {

constexpr double kHillsDriveS = 25;

double ground_at(const Scene& scene, double station, double left) {
  const Placement at = scene.road.at(station, left);
  return scene.ground_at(at.x, at.y);
}

// The way up from the road's surface at that place to what hangs over it.
double clearance(const Scene& scene, double station, double left) {
  const Placement at = scene.road.at(station, left);
  std::vector<Solid> solids;
  scene.landscape.append_seen_from(station, solids);
  double nearest = kNoHit;
  for (const Solid& solid : solids) {
    nearest = std::min(nearest,
                       distance_to(solid, {{at.x, at.y, scene.ground_at(at.x, at.y)}, {0, 0, 1}}));
  }
  return nearest;
}

TEST(Hills, SlopeByTenDegreesAtMost) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Scene scene = make_hills(seed, kHillsDriveS);
    double steepest = 0;
    for (double station = -200; station < 400; station += 1) {
      const double slope =
          ground_at(scene, station + 0.5, -1.75) - ground_at(scene, station - 0.5, -1.75);
      steepest = std::max(steepest, std::abs(slope));
    }
    EXPECT_LT(steepest, std::tan(10.05 * 3.14159265 / 180)) << seed;
    EXPECT_GT(steepest, std::tan(7.9 * 3.14159265 / 180)) << seed;
  }
}

TEST(Hills, AKerbIsTwelveCentimetresHigh) {
  const Scene scene = make_hills(1, kHillsDriveS);
  for (const double station : {3.0, 35.0, 70.0, 115.0, 190.0}) {
    const double road = ground_at(scene, station, -(kHillsKerb - 0.4));
    const double pavement = ground_at(scene, station, -(kHillsKerb + 0.4));
    EXPECT_NEAR(pavement - road, 0.12, 0.002) << station;
    // A beam along the gutter's height ends at the kerb's face.
    const Placement at = scene.road.at(station, -(kHillsKerb - 1));
    const Ray ray{{at.x, at.y, scene.ground_at(at.x, at.y) + 0.05}, {at.sin, -at.cos, 0}};
    std::vector<Solid> solids;
    scene.landscape.append_seen_from(station, solids);
    double nearest = kNoHit;
    for (const Solid& solid : solids) {
      if (solid.material == Material::kKerb) {
        nearest = std::min(nearest, distance_to(solid, ray));
      }
    }
    EXPECT_NEAR(nearest, 1 - kHillsKerbWidth / 2, 0.02) << station;
  }
}

TEST(Hills, GateAndBridgeLeaveTheRoomThatTheySay) {
  const Scene scene = make_hills(2, kHillsDriveS);
  for (const double act : {0.0, kHillsActM}) {
    EXPECT_NEAR(clearance(scene, act + kHillsGateM, -1), 2.5, 0.05);
    EXPECT_NEAR(clearance(scene, act + kHillsBridgeM, 0), 4.6, 0.05);
    EXPECT_EQ(clearance(scene, act + kHillsBridgeM + 15, 0), kNoHit);
  }
}

TEST(Hills, BeamsPassThroughWindowsAndOverBonnets) {
  std::vector<Solid> car;
  add_glazed_car({}, {.x = 10, .y = 0, .cos = 0, .sin = 1}, car);  // across the beam
  const auto nearest = [&](double y, double z) {
    double distance = kNoHit;
    for (const Solid& part : car) {
      distance = std::min(distance, distance_to(part, {{0, y, z}, {1, 0, 0}}));
    }
    return distance;
  };
  EXPECT_NEAR(nearest(0, 0.6), 10 - 1.75 / 2, 1e-9);  // the door
  EXPECT_EQ(nearest(0.3, 1.2), kNoHit);               // through both side windows
  EXPECT_LT(nearest(0, 1.46), kNoHit);                // the roof
  EXPECT_EQ(nearest(1.6, 1.2), kNoHit);               // over the bonnet
}

TEST(Hills, TheCarStandsOnItsWheels) {
  const Scene scene = make_hills(3, kHillsDriveS);
  for (double time_s = 0.5; time_s < kHillsDriveS; time_s += 0.7) {
    const EgoPose ego = scene.ego_at(time_s);
    const SensorFrame car = placed(
        {.origin = {0, 0, 0}, .forward = {1, 0, 0}, .left = {0, 1, 0}, .up = {0, 0, 1}}, ego);
    for (const double forward : {1.35, -1.35}) {
      for (const double left : {0.75, -0.75}) {
        const Vector3 arm = car.direction({forward, left, 0});
        const Vector3 wheel{car.origin.x + arm.x, car.origin.y + arm.y, car.origin.z + arm.z};
        // The car's own nodding, bends of the road, and the crown between its wheels.
        EXPECT_NEAR(wheel.z, scene.ground_at(wheel.x, wheel.y), 0.06) << time_s;
      }
    }
  }
}

// No thing hangs in the air, and none is deep in the ground.
TEST(Hills, WhatDrivesIsOnTheGround) {
  const Scene scene = make_hills(3, kHillsDriveS);
  for (const double time_s : {1.0, 9.0, 17.0}) {
    std::vector<Solid> solids;
    scene.append_seen_at(time_s, solids);
    int cars = 0;
    for (const Solid& solid : solids) {
      if (solid.material == Material::kCar && solid.z_low < 0.5) {
        EXPECT_NEAR(solid.footing.z, scene.ground_at(solid.at.x, solid.at.y), 1e-9);
        ++cars;
      }
    }
    EXPECT_GT(cars, 20);
  }
}

}  // namespace
}  // namespace iog::tools
