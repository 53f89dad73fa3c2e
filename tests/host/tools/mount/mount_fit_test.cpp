// What many turns say together, and when they say nothing.
#include "tools/mount/mount_fit.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "gtest/gtest.h"

#include "pose/message.hpp"

namespace iog::tools {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

struct Vector {
  double x, y, z;
};

// Roll about x, then pitch about y, then yaw about z: docs/vehicles.md, written out.
Vector turned(const Vector& v, const description::MountConfig& by) {
  const double roll = by.roll_deg * kRadiansPerDegree;
  const double pitch = by.pitch_deg * kRadiansPerDegree;
  const double yaw = by.yaw_deg * kRadiansPerDegree;
  const Vector rolled{v.x, v.y * std::cos(roll) - v.z * std::sin(roll),
                      v.y * std::sin(roll) + v.z * std::cos(roll)};
  const Vector pitched{rolled.x * std::cos(pitch) + rolled.z * std::sin(pitch), rolled.y,
                       -rolled.x * std::sin(pitch) + rolled.z * std::cos(pitch)};
  return {pitched.x * std::cos(yaw) - pitched.y * std::sin(yaw),
          pitched.x * std::sin(yaw) + pitched.y * std::cos(yaw), pitched.z};
}

// How the level ground lies in the axes of a file that says another mount than the true one: the
// plane through three points of it.
GroundPlane seen_by_file(const description::MountConfig& truth,
                         const description::MountConfig& by_file) {
  const auto in_file = [&](const Vector& in_sensor) { return turned(in_sensor, by_file); };
  // Three directions of the sensor, as long as they have to be to end on the ground.
  const auto on_ground = [&](const Vector& direction) {
    const double down = -turned(direction, truth).z;
    const double length = truth.z_m / down;
    return in_file({direction.x * length, direction.y * length, direction.z * length});
  };
  // Down, whatever the mount: what in the sensor frame points downward in the car.
  const auto sensor_of = [&](const Vector& in_car) {
    const Vector x = turned({1, 0, 0}, truth);
    const Vector y = turned({0, 1, 0}, truth);
    const Vector z = turned({0, 0, 1}, truth);
    return Vector{x.x * in_car.x + x.y * in_car.y + x.z * in_car.z,
                  y.x * in_car.x + y.y * in_car.y + y.z * in_car.z,
                  z.x * in_car.x + z.y * in_car.y + z.z * in_car.z};
  };
  const Vector a = on_ground(sensor_of({0, 0, -1}));
  const Vector b = on_ground(sensor_of({1, 0, -1}));
  const Vector c = on_ground(sensor_of({0, 1, -1}));
  const Vector u{b.x - a.x, b.y - a.y, b.z - a.z};
  const Vector v{c.x - a.x, c.y - a.y, c.z - a.z};
  const Vector normal{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  const double along = -normal.x / normal.z;
  const double across = -normal.y / normal.z;
  return {.along = along, .across = across, .below_m = along * a.x + across * a.y - a.z};
}

TEST(MountOf, IsThatOfTheDescription) {
  for (const double yaw : {0.0, 37.0, -120.0, 180.0}) {
    for (const double pitch : {-5.0, 0.0, 3.0}) {
      for (const double roll : {-4.0, 0.0, 5.0}) {
        const description::MountConfig truth{
            .z_m = 1.7, .yaw_deg = yaw, .pitch_deg = pitch, .roll_deg = roll};
        const description::MountConfig by_file{
            .z_m = 1.4, .yaw_deg = yaw, .pitch_deg = 1, .roll_deg = -2};
        const TurnMount found = mount_of(seen_by_file(truth, by_file), by_file);
        EXPECT_NEAR(found.pitch_deg, pitch, 1e-9) << yaw << " " << pitch << " " << roll;
        EXPECT_NEAR(found.roll_deg, roll, 1e-9) << yaw << " " << pitch << " " << roll;
        EXPECT_NEAR(found.z_m, 1.7, 1e-9);
      }
    }
  }
}

TEST(MountOf, AUnitMayHangUpsideDown) {
  const description::MountConfig truth{.z_m = 3, .yaw_deg = 10, .pitch_deg = 2, .roll_deg = 177};
  const description::MountConfig by_file{.z_m = 3, .yaw_deg = 10, .pitch_deg = 0, .roll_deg = 180};
  const TurnMount found = mount_of(seen_by_file(truth, by_file), by_file);
  EXPECT_NEAR(found.pitch_deg, 2, 1e-9);
  EXPECT_NEAR(found.roll_deg, 177, 1e-9);
}

// A unit that hangs rolls to either side of half a turn, and a file calls it 180 or -180.
TEST(MountOf, TheRollIsWithinHalfATurnOfTheFiles) {
  for (const double by_file : {-180.0, 180.0}) {
    for (const double truth : {-179.5, 179.5}) {
      const description::MountConfig mount{.z_m = 2, .roll_deg = by_file};
      const TurnMount found = mount_of(seen_by_file({.z_m = 2, .roll_deg = truth}, mount), mount);
      EXPECT_NEAR(std::abs(found.roll_deg - by_file), 0.5, 1e-9) << by_file << " " << truth;
    }
  }
}

// So many turns, a tenth of a second each, of 1 degree of pitch, 2 of roll and 1.5 m.
std::vector<TurnMount> turns(std::size_t count) {
  std::vector<TurnMount> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double swing = i % 2 == 0 ? 0.1 : -0.1;
    all[i] = {.time_us = 1'000'000 + i * 100'000,
              .pitch_deg = 1 + swing,
              .roll_deg = 2 - swing,
              .z_m = 1.5 + swing / 10,
              .residual_m = 0.02};
  }
  return all;
}

TEST(MountFit, IsTheMedian) {
  std::vector<TurnMount> all = turns(151);
  for (std::size_t i = 3; i < all.size(); i += 4) {
    all[i].pitch_deg = 9;  // strays, as many to one side as to the other
    all[i - 2].pitch_deg = -9;
  }
  const MountFit fit = fit_of(all, all.size(), {});
  EXPECT_EQ(fit.refusal, "");
  EXPECT_EQ(fit.taken, 151U);
  EXPECT_NEAR(fit.pitch_deg.value, 1, 0.11);
  EXPECT_NEAR(fit.roll_deg.value, 2, 0.11);
  EXPECT_NEAR(fit.z_m.value, 1.5, 0.011);
  EXPECT_NEAR(fit.apart_s, 5, 0.15);
  EXPECT_NEAR(fit.roll_deg.scatter, 0.15, 0.15);
  EXPECT_TRUE(fit.has_roll());
}

TEST(MountFit, FewerThanFiftyTurnsAreTooFew) {
  EXPECT_EQ(fit_of(turns(50), 50, {}).refusal, "");
  EXPECT_NE(fit_of(turns(49), 60, {}).refusal.find("49 of 60 turns"), std::string::npos);
  EXPECT_NE(fit_of({}, 0, {}).refusal, "");
}

// Else it reads as if the car had never driven evenly.
TEST(MountFit, TurnsWhosePosesAreOfAnotherTimeAreTold) {
  MotionLog motion;
  pose::Encoder encoder;
  motion.add(3'600'000'000, encoder.encode({.run = 1, .clock_us = 1'714'564'800'000'000}));
  motion.sort();
  ASSERT_FALSE(motion.is_empty());
  EXPECT_NE(fit_of(turns(60), 60, motion).refusal.find("60 more have no pose"), std::string::npos);
}

TEST(MountFit, PartsThatDifferAreNoMount) {
  std::vector<TurnMount> all = turns(150);
  for (std::size_t i = 100; i < 150; ++i) {
    all[i].roll_deg += 0.6;
  }
  MountFit fit = fit_of(all, 150, {});
  EXPECT_EQ(fit.refusal, "");
  EXPECT_FALSE(fit.has_roll());
  for (std::size_t i = 100; i < 150; ++i) {
    all[i].pitch_deg += 0.6;
  }
  EXPECT_NE(fit_of(all, 150, {}).refusal.find("of pitch"), std::string::npos);
  all = turns(150);
  for (std::size_t i = 0; i < 50; ++i) {
    all[i].z_m -= 0.12;
  }
  EXPECT_NE(fit_of(all, 150, {}).refusal.find("of height"), std::string::npos);
}

}  // namespace
}  // namespace iog::tools
