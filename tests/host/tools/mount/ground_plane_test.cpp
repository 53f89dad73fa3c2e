// Planes that are known, seen by a lidar of sixteen rings that is made here; and what is no ground.
#include "tools/mount/ground_plane.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kHeightM = 1.6;

// How far a beam of that direction goes; 0: it meets nothing.
using Surface = std::function<double(double x, double y, double z)>;

// What comes back from the lane: each ring looks 2 degrees lower than the one above it, unless the
// elevations are others.
std::vector<RoadReturn> scan_of(const Surface& surface,
                                const std::vector<double>& rings = {
                                    -15, -13, -11, -9, -7, -5, -3, -1, 1, 3, 5, 7, 9, 11, 13, 15}) {
  std::vector<RoadReturn> returns;
  for (const double ring : rings) {
    for (int step = 0; step < 1800; ++step) {
      const double azimuth = step * 0.2 * kDegree;
      const double x = std::cos(ring * kDegree) * std::cos(azimuth);
      const double y = std::cos(ring * kDegree) * std::sin(azimuth);
      const double z = std::sin(ring * kDegree);
      const double range = surface(x, y, z);
      const RoadReturn point{.x_m = range * x, .y_m = range * y, .z_m = range * z};
      const double out_m = std::hypot(point.x_m, point.y_m);
      if (out_m >= kNearestRoadM && out_m < kFarthestRoadM && std::abs(point.y_m) < 2) {
        returns.push_back(point);
      }
    }
  }
  return returns;
}

Surface plane(double along, double across, double below_m) {
  return [=](double x, double y, double z) {
    const double down = along * x + across * y - z;
    return down > 0 ? below_m / down : 0;
  };
}

// The nearer of two.
Surface before(const Surface& a, const Surface& b) {
  return [=](double x, double y, double z) {
    const double near = a(x, y, z);
    const double far = b(x, y, z);
    return near == 0 || (far != 0 && far < near) ? far : near;
  };
}

// Upright and across the lane, ahead or behind, up to so far over the unit.
Surface wall(double at_x_m, double top_m = 100) {
  return [=](double x, double, double z) {
    return x * at_x_m > 0 && z * at_x_m / x < top_m ? at_x_m / x : 0;
  };
}

TEST(GroundPlane, IsFoundHoweverItIsTilted) {
  for (const double pitch : {-5.0, 0.0, 3.0}) {
    for (const double roll : {-5.0, 0.0, 4.0}) {
      for (const double off_m : {-0.3, 0.0, 0.3}) {
        const double along = std::tan(pitch * kDegree);
        const double across = std::tan(roll * kDegree);
        const auto found =
            ground_plane_of(scan_of(plane(along, across, kHeightM)), kHeightM + off_m);
        ASSERT_TRUE(found) << pitch << " " << roll << " " << off_m;
        EXPECT_NEAR(found->along, along, 1e-9);
        EXPECT_NEAR(found->across, across, 1e-9);
        EXPECT_NEAR(found->below_m, kHeightM, 1e-9);
        EXPECT_NEAR(found->residual_m, 0, 1e-9);
      }
    }
  }
}

// Boots and bonnets, 1 m high, 12 m ahead and 9 m behind: they hide the road behind them.
TEST(GroundPlane, IsFoundBetweenCars) {
  const auto found = ground_plane_of(
      scan_of(before(plane(0.02, 0.01, kHeightM), before(wall(12, -0.6), wall(-9, -0.6)))),
      kHeightM);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->along, 0.02, 0.004);
  EXPECT_NEAR(found->across, 0.01, 0.004);
  EXPECT_NEAR(found->below_m, kHeightM, 0.02);
}

// A high unit in traffic, its rings dense near the horizon as a Pandar64's are: most returns of the
// lane are of the van ahead and the car behind.
TEST(GroundPlane, IsFoundBetweenThingsThatReturnMoreThanTheRoad) {
  std::vector<double> rings = {-24.9, -18.9, -14, -13, -12, -11, -9.9, -9.1, -8.1, -7.1};
  for (int ring = -36; ring <= 12; ++ring) {
    rings.push_back(ring / 6.0);
  }
  constexpr double kRoofM = 2.15;
  for (const double van_m : {9.0, 10.5, 13.0}) {
    const std::vector<RoadReturn> returns = scan_of(
        before(plane(0.01, 0.04, kRoofM), before(wall(van_m, 0.3), wall(-9.5, -0.7))), rings);
    const auto found = ground_plane_of(returns, kRoofM);
    ASSERT_TRUE(found) << van_m;
    EXPECT_NEAR(found->along, 0.01, 0.004) << van_m;
    EXPECT_NEAR(found->across, 0.04, 0.004) << van_m;
    EXPECT_NEAR(found->below_m, kRoofM, 0.02) << van_m;
  }
}

TEST(GroundPlane, WallsAreNone) {
  EXPECT_FALSE(ground_plane_of(scan_of(wall(8)), kHeightM));
  EXPECT_FALSE(ground_plane_of(scan_of(before(wall(8), wall(-6))), kHeightM));
  EXPECT_FALSE(ground_plane_of(scan_of([](double, double, double) { return 9; }), kHeightM));
}

TEST(GroundPlane, TooLittleIsNone) {
  EXPECT_FALSE(ground_plane_of({}, kHeightM));
  std::vector<RoadReturn> returns = scan_of(plane(0, 0, kHeightM));
  returns.resize(150);
  EXPECT_FALSE(ground_plane_of(returns, kHeightM));
  // One place, however often it is seen.
  EXPECT_FALSE(ground_plane_of(std::vector<RoadReturn>(1'000, {6, 1, -kHeightM}), kHeightM));
}

// A hill's top: the slope changes by 4 degrees within 20 m.
TEST(GroundPlane, ABentRoadIsNone) {
  const auto bent = [](double bend) {
    std::vector<RoadReturn> returns = scan_of(plane(0, 0, kHeightM));
    for (RoadReturn& point : returns) {
      point.z_m += bend * point.x_m * point.x_m / 2;
    }
    return returns;
  };
  EXPECT_TRUE(ground_plane_of(bent(0.5 * kDegree / 20), kHeightM));
  EXPECT_FALSE(ground_plane_of(bent(4 * kDegree / 20), kHeightM));
  EXPECT_FALSE(ground_plane_of(bent(-4 * kDegree / 20), kHeightM));
}

// A unit that the file puts two metres too high, or tilts by 20 degrees too much, is found as it is
// or not at all.
TEST(GroundPlane, FarFromTheFileItIsRightOrNone) {
  for (const double off_m : {-2.0, -1.2, 1.2, 2.0}) {
    for (const double degrees : {-20.0, 0.0, 12.0}) {
      const double along = std::tan(degrees * kDegree);
      const auto found = ground_plane_of(scan_of(plane(along, 0, kHeightM)), kHeightM + off_m);
      if (found) {
        EXPECT_NEAR(found->along, along, 1e-9) << off_m << " " << degrees;
        EXPECT_NEAR(found->below_m, kHeightM, 1e-9) << off_m << " " << degrees;
      }
    }
  }
}

}  // namespace
}  // namespace iog::tools
