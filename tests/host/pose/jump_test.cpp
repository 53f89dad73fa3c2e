// What is a jump, and what only looks like one.
#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "pose/drive.hpp"

namespace iog::pose {
namespace {

using testing::Driven;
using testing::message_at;

constexpr std::uint64_t kMs = 1'000;

// A source that is off its place by ever more: by `step_mm` (to the left) each 10 ms, `steps`
// times. What happened with each message, first of all the steps.
std::uint32_t epoch_after_shift(std::int32_t step_mm, int steps, std::uint64_t period_us) {
  Driven driven;
  Message message;
  for (int i = 1; i <= steps; ++i) {
    message = message_at(driven.newest_us + static_cast<std::uint64_t>(i) * period_us);
    message.pose.y_mm = i * step_mm;
    EXPECT_EQ(driven.take(message), Fate::kUsed);
  }
  return driven.history.epoch();
}

TEST(Jump, IsAStepOfMoreThanThreeHundredMillimetres) {
  EXPECT_EQ(epoch_after_shift(300, 1, 10 * kMs), 0U);
  EXPECT_EQ(epoch_after_shift(301, 1, 10 * kMs), 1U);
  EXPECT_EQ(epoch_after_shift(-301, 1, 10 * kMs), 1U);
  EXPECT_EQ(epoch_after_shift(301, 1, 1'000 * kMs), 1U) << "after a gap, too";
}

TEST(Jump, IsASlowShiftOfAsMuchWithinASecond) {
  EXPECT_EQ(epoch_after_shift(30, 10, 10 * kMs), 0U);
  EXPECT_EQ(epoch_after_shift(31, 9, 10 * kMs), 0U);
  EXPECT_EQ(epoch_after_shift(31, 10, 10 * kMs), 1U);
  EXPECT_EQ(epoch_after_shift(30, 40, 100 * kMs), 0U) << "10 of them are within a second";
  EXPECT_EQ(epoch_after_shift(31, 10, 100 * kMs), 1U);
}

TEST(Jump, IsATurnOfAsMuchAtFiftyMetres) {
  const auto limit = static_cast<std::uint32_t>(0.006 / (2 * 3.14159265358979) * 4'294'967'296.0);
  for (const bool is_above : {false, true}) {
    Driven driven;
    Message message = message_at(driven.newest_us + 10 * kMs);
    message.pose.heading = limit + (is_above ? 2 : 0);
    ASSERT_EQ(driven.take(message), Fate::kUsed);
    EXPECT_EQ(driven.history.epoch(), is_above ? 1U : 0U);
  }
}

// However long the history was.
TEST(Jump, BreaksTheHistoryWhereItIs) {
  for (const std::uint64_t count : {50U, 500U}) {
    Driven driven(count);
    Message message = message_at(driven.newest_us + 10 * kMs);
    message.pose.y_mm = 500;
    ASSERT_EQ(driven.take(message), Fate::kUsed);
    EXPECT_EQ(driven.history.breaks(Cause::kJump).times, 1U);
    EXPECT_EQ(driven.history.breaks(Cause::kJump).since_us, message.clock_us);
    EXPECT_EQ(driven.cause_at(driven.newest_us), Cause::kJump) << "before it there is nothing";
    EXPECT_EQ(driven.cause_at(message.clock_us - 1), Cause::kJump) << "nor a way across it";
    EXPECT_EQ(driven.history.pose_at(message.clock_us).pose, message.pose);
    Message next = message_at(driven.newest_us + 20 * kMs);
    next.pose.y_mm = 500;
    ASSERT_EQ(driven.take(next), Fate::kUsed);
    EXPECT_EQ(driven.history.epoch(), 1U) << "it stays where it went";
  }
}

// Two steps of 200 mm are one jump within a second, and none beyond it.
TEST(Jump, AStepIsForgottenAfterASecond) {
  for (const std::uint64_t apart_us : {990 * kMs, 1'000 * kMs}) {
    Driven driven;
    for (std::uint64_t i = 1; i <= 150; ++i) {
      Message message = message_at(driven.newest_us + i * 10 * kMs);
      message.pose.y_mm = i * 10 * kMs > apart_us ? 400 : 200;
      ASSERT_EQ(driven.take(message), Fate::kUsed);
    }
    EXPECT_EQ(driven.history.epoch(), apart_us < 1'000 * kMs ? 1U : 0U);
  }
}

// A source that takes its speed from its own positions explains half of a jump by that speed. So
// the speed before counts, of two messages at most 100 ms apart (docs/spec.md, 5.5); later it may
// have changed.
TEST(Jump, IsLookedForByTheSpeedBeforeForAHundredMilliseconds) {
  for (const std::int32_t apart_us : {10'000, 99'999, 100'000, 100'001}) {
    Driven driven;
    Message message = message_at(driven.newest_us + static_cast<std::uint64_t>(apart_us));
    message.pose.x_mm += 400;
    message.speed_mm_per_s = 10'000 + 800'000'000 / apart_us;  // with 10'000 before, 400 mm more
    ASSERT_EQ(driven.take(message), Fate::kUsed);
    EXPECT_EQ(driven.history.epoch(), apart_us <= 100'000 ? 1U : 0U) << apart_us;
  }
}

// The state of a car, in double.
struct Car {
  double x = 0;
  double y = 0;
  double heading = 0;
  double speed = 20;
  double yaw_rate = 0;

  void drive(double seconds, double acceleration, double yaw_acceleration) {
    constexpr double kStep = 1e-4;
    for (double t = 0; t < seconds - kStep / 2; t += kStep) {
      speed = std::max(0.0, speed + acceleration * kStep);
      yaw_rate += yaw_acceleration * kStep;
      heading += yaw_rate * kStep;
      x += speed * std::cos(heading) * kStep;
      y += speed * std::sin(heading) * kStep;
    }
  }

  [[nodiscard]] Message message_at(std::uint64_t clock_us) const {
    const double turns = heading / (2 * 3.14159265358979323846);
    return {.run = 1,
            .clock_us = clock_us,
            .pose = {.x_mm = static_cast<std::int32_t>(std::llround(x * 1000)),
                     .y_mm = static_cast<std::int32_t>(std::llround(y * 1000)),
                     .heading = static_cast<std::uint32_t>(
                         static_cast<std::int64_t>(std::floor(turns * 4'294'967'296.0)))},
            .sigma = {10, 10},
            .speed_mm_per_s = static_cast<std::int32_t>(std::llround(speed * 1000)),
            .yaw_urad_per_s = static_cast<std::int32_t>(std::llround(yaw_rate * 1e6))};
  }
};

std::uint32_t epoch_of(int messages, double period_s, double acceleration,
                       double yaw_acceleration) {
  History history;
  Car car;
  const auto period_us = static_cast<std::uint64_t>(period_s * 1e6);
  for (int i = 0; i < messages; ++i) {
    static_cast<void>(history.add(
        car.message_at(testing::kStartUs + static_cast<std::uint64_t>(i) * period_us), 0));
    // Half a second to and half a second fro, so that the yaw rate stays below 0.5 rad/s.
    const bool is_to = static_cast<int>(i * period_s / 0.5) % 2 == 0;
    car.drive(period_s, acceleration, is_to ? yaw_acceleration : -yaw_acceleration);
  }
  EXPECT_TRUE(history.newest().has_value());
  return history.epoch();
}

// Braking as hard as tyres can, and turning into curves and out of them, at every rate that a
// source may have.
TEST(Jump, IsNotHowACarMoves) {
  for (const double period_s : {0.01, 0.02, 0.05, 0.1}) {
    const int messages = static_cast<int>(3 / period_s);
    EXPECT_EQ(epoch_of(messages, period_s, -9.0, 0), 0U) << period_s;
    EXPECT_EQ(epoch_of(messages, period_s, 3.0, 1.0), 0U) << period_s;
    EXPECT_EQ(epoch_of(messages, period_s, -9.0, 1.0), 0U) << period_s;
  }
}

// Noise of a source adds up to nothing: each pose is held against the one before it.
TEST(Jump, IsNotANoisyPosition) {
  tests::Random random(11);
  Driven driven;
  for (std::uint64_t i = 1; i <= 1'000; ++i) {
    Message message = message_at(driven.newest_us + i * 10 * kMs);
    message.pose.x_mm += random.between(-60, 60);
    message.pose.y_mm += random.between(-60, 60);
    ASSERT_EQ(driven.take(message), Fate::kUsed);
  }
  EXPECT_EQ(driven.history.epoch(), 0U);
}

}  // namespace
}  // namespace iog::pose
