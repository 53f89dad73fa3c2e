// A mount is a rotation by yaw, pitch and roll about z, y and x, in this order (docs/vehicles.md).
#include "tools/car/mount.hpp"

#include <gtest/gtest.h>

namespace iog::description {
namespace {

using Axis = std::array<double, 3>;

double dot(const Axis& a, const Axis& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void expect_near(const Axis& axis, const Axis& expected) {
  for (std::size_t i = 0; i < axis.size(); ++i) {
    EXPECT_NEAR(axis[i], expected[i], 1e-9) << i;
  }
}

Axis cross(const Axis& a, const Axis& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

TEST(Mount, AQuarterTurnIsWhatAHandShows) {
  const Rotation left = rotation_of({.yaw_deg = 90});
  expect_near(left.forward, {0, 1, 0});
  expect_near(left.left, {-1, 0, 0});
  const Rotation down = rotation_of({.pitch_deg = 90});
  expect_near(down.forward, {0, 0, -1});
  expect_near(down.up, {1, 0, 0});
  const Rotation over = rotation_of({.roll_deg = 90});
  expect_near(over.left, {0, 0, 1});
  expect_near(over.up, {0, -1, 0});
}

// Whatever the angles: three axes of length 1, at right angles, right-handed. Roll leaves what is
// forward, and the height of the tip of forward is that of the pitch alone.
TEST(Mount, ItsAxesAreThoseOfARotation) {
  for (const double yaw : {-170.0, -35.0, 0.0, 12.5, 100.0}) {
    for (const double pitch : {-60.0, -5.0, 0.0, 20.0, 85.0}) {
      for (const double roll : {-175.0, -30.0, 0.0, 3.0, 90.0}) {
        const Rotation turn = rotation_of({.yaw_deg = yaw, .pitch_deg = pitch, .roll_deg = roll});
        EXPECT_NEAR(dot(turn.forward, turn.forward), 1, 1e-9);
        EXPECT_NEAR(dot(turn.left, turn.left), 1, 1e-9);
        EXPECT_NEAR(dot(turn.forward, turn.left), 0, 1e-9);
        expect_near(turn.up, cross(turn.forward, turn.left));
        expect_near(turn.forward, rotation_of({.yaw_deg = yaw, .pitch_deg = pitch}).forward);
        EXPECT_NEAR(turn.forward[2], rotation_of({.pitch_deg = pitch}).forward[2], 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace iog::description
