#include "tools/mount/motion_log.hpp"

#include <functional>

#include "gtest/gtest.h"

#include "pose/message.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kStartUs = 1'714'564'800'000'000U;

// Poses of four seconds, fifty a second: speed in m/s and turn in rad/s by the time in s.
MotionLog log_of(const std::function<double(double)>& speed, double turn) {
  MotionLog log;
  pose::Encoder encoder;
  for (int i = 0; i < 200; ++i) {
    const double time_s = i / 50.0;
    pose::Message message;
    message.run = 1;
    message.clock_us = kStartUs + static_cast<std::uint64_t>(i) * 20'000;
    message.speed_mm_per_s = static_cast<std::int32_t>(1000 * speed(time_s));
    message.yaw_urad_per_s = static_cast<std::int32_t>(1e6 * turn);
    const auto bytes = encoder.encode(message);
    log.add(message.clock_us, bytes);
  }
  log.sort();
  return log;
}

CarState in_middle(const MotionLog& log) { return log.at(kStartUs + 2'000'000); }

TEST(MotionLog, KnowsWhatACarDoes) {
  const auto steady = [](double metres) { return [=](double) { return metres; }; };
  EXPECT_EQ(in_middle(log_of(steady(10), 0)), CarState::kDrives);
  EXPECT_EQ(in_middle(log_of(steady(-5), 0)), CarState::kDrives);
  EXPECT_EQ(in_middle(log_of(steady(0), 0)), CarState::kStands);
  EXPECT_EQ(in_middle(log_of(steady(1.5), 0)), CarState::kStands);
  // 10 m/s times 0.09 and 0.11 rad/s.
  EXPECT_EQ(in_middle(log_of(steady(10), 0.09)), CarState::kDrives);
  EXPECT_EQ(in_middle(log_of(steady(10), -0.11)), CarState::kLeans);
  EXPECT_EQ(in_middle(log_of([](double t) { return 10 - 0.9 * t; }, 0)), CarState::kDrives);
  EXPECT_EQ(in_middle(log_of([](double t) { return 10 - 1.1 * t; }, 0)), CarState::kLeans);
}

TEST(MotionLog, KnowsNothingFarFromItsPoses) {
  const MotionLog log = log_of([](double) { return 10; }, 0);
  EXPECT_EQ(log.at(kStartUs + 5'000'000), CarState::kUnknown);
  EXPECT_EQ(log.at(0), CarState::kUnknown);
  EXPECT_EQ(MotionLog().at(kStartUs), CarState::kUnknown);
}

TEST(MotionLog, LeavesAloneWhatIsNoPose) {
  MotionLog log;
  log.add(kStartUs, std::vector<std::byte>(100));
  log.add(kStartUs, {});
  EXPECT_TRUE(log.is_empty());
}

}  // namespace
}  // namespace iog::tools
