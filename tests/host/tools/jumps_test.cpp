// A log whose poses jump is known before it is fused.
#include "tools/poses/jumps.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "tools/poses/pose_encoder.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools {
namespace {

// A circle of 50 m to the left at 10 m/s, 50 times a second for 20 s.
JumpTime jumps_of(const std::function<void(int number, PoseSample&)>& spoil) {
  PoseEncoder encoder;
  std::vector<CapturedDatagram> poses;
  for (int i = 0; i < 1'000; ++i) {
    const double angle = 0.004 * i;
    PoseSample sample{.time_us = 1'000'000'000 + static_cast<std::uint64_t>(i) * 20'000,
                      .x_m = 50 * std::sin(angle),
                      .y_m = 50 * (1 - std::cos(angle)),
                      .heading_rad = angle,
                      .speed_mps = 10,
                      .yaw_rate_rps = 0.2,
                      .sigma_m = 0.05,
                      .sigma_heading_rad = 0.002};
    spoil(i, sample);
    poses.push_back(encoder.datagram_of(sample));
  }
  return time_lost_by_jumps(poses);
}

// The first three poses wait for each other.
constexpr std::uint64_t kAllUs = 997 * 20'000;

TEST(Jumps, SmoothPosesHaveNone) {
  const JumpTime time = jumps_of([](int /*number*/, PoseSample& /*sample*/) {});
  EXPECT_EQ(time.lost_us, 0U);
  EXPECT_EQ(time.all_us, kAllUs);
}

TEST(Jumps, ALeapLosesTheTimeOfOneStep) {
  const JumpTime time =
      jumps_of([](int number, PoseSample& sample) { sample.x_m += number < 500 ? 0.0 : 1.0; });
  EXPECT_EQ(time.lost_us, 20'000U);
  EXPECT_EQ(time.all_us, kAllUs);
}

// Each heading is off by up to 6 mrad and more from the one before.
TEST(Jumps, NoisyHeadingsLoseMostOfTheTime) {
  Random random(1);
  const JumpTime time = jumps_of([&](int /*number*/, PoseSample& sample) {
    sample.heading_rad += random.between(-0.02, 0.02);
  });
  EXPECT_GT(time.lost_us, kAllUs / 2);
  EXPECT_EQ(time.all_us, kAllUs);
}

// A pause of the log is not time that a target could use.
TEST(Jumps, PausesDoNotHideThem) {
  Random random(1);
  const JumpTime time = jumps_of([&](int number, PoseSample& sample) {
    sample.time_us += static_cast<std::uint64_t>(number / 250) * 300'000'000;
    sample.heading_rad += random.between(-0.02, 0.02);
  });
  EXPECT_GT(2 * time.lost_us, time.all_us);
}

}  // namespace
}  // namespace iog::tools
