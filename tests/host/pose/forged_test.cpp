// Messages that nobody should have sent: whatever they say, they blind nobody for longer than a
// second after the last of them (docs/spec.md, section 5.2).
#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>

#include "pose/drive.hpp"

namespace iog::pose {
namespace {

using testing::kStartUs;
using testing::message_at;

constexpr std::uint64_t kMs = 1'000;
constexpr std::uint64_t kPeriodUs = 10 * kMs;
constexpr std::uint64_t kHourUs = 3'600'000 * kMs;
constexpr std::uint64_t kLastClockUs = kMaxClockUs;

// The target's clock is 0 where the true source's is kStartUs.
struct Target {
  // The true source, on the way for 1 ms. How many of its messages were used.
  int drive(std::uint64_t count, std::uint32_t run = 1) {
    int used = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      now_us += kPeriodUs;
      used += take(message_at(kStartUs + now_us - 1 * kMs, run)) == Fate::kUsed ? 1 : 0;
    }
    return used;
  }
  // Someone else's, who stands at another place and says that it is another time.
  Fate forge(std::uint64_t clock_us, std::uint32_t run, std::uint32_t age_us = 0) {
    return take({.run = run,
                 .age_us = age_us,
                 .clock_us = clock_us,
                 .pose = {-5'000'000, 5'000'000, 0},
                 .sigma = {1, 1}});
  }
  void forge_three(std::uint64_t clock_us, std::uint32_t run) {
    for (std::uint64_t i = 0; i < 3; ++i) {
      static_cast<void>(forge(clock_us - (2 - i) * kPeriodUs, run));
    }
  }
  Fate take(const Message& message) { return history.add(message, now_us); }
  [[nodiscard]] bool is_at_truth() const {
    const Message truth = message_at(kStartUs + now_us - 1 * kMs);
    const Placed placed = history.pose_at(truth.clock_us);
    return placed.has_pose() && placed.pose == truth.pose;
  }
  // A second later the true source is believed, and all that it says.
  void expect_truth_again() {
    drive(101 + kConfirmations);
    EXPECT_TRUE(is_at_truth());
    EXPECT_EQ(drive(1'000), 1'000);
  }

  History history;
  std::uint64_t now_us = 0;
};

TEST(Forged, AClockOfTheFutureInThePresentRunChangesNothing) {
  for (const std::uint64_t ahead_us :
       {3'000 * kMs, 10'000 * kMs, kHourUs, kLastClockUs - 2 * kHourUs}) {
    for (const std::uint32_t age_us : {std::uint32_t{0}, kMaxAgeUs}) {
      Target target;
      target.drive(100);
      EXPECT_EQ(target.forge(kStartUs + target.now_us + ahead_us, 1, age_us), Fate::kUnconfirmed);
      EXPECT_EQ(target.drive(500), 500) << ahead_us;
      EXPECT_TRUE(target.is_at_truth());
      EXPECT_EQ(target.history.epoch(), 0U);
    }
  }
}

// It need not leap: a little ahead is as good as true, until its course is silent.
TEST(Forged, AClockALittleAheadIsBelievedForASecond) {
  Target target;
  target.drive(100);
  EXPECT_EQ(target.forge(kStartUs + target.now_us + 1'900 * kMs, 1), Fate::kUsed);
  target.drive(100 + kConfirmations);
  EXPECT_TRUE(target.is_at_truth());
  EXPECT_EQ(target.drive(1'000), 1'000);
}

// As many steps as it likes, each as large as one may be, or three in a row anywhere, up to the
// last clock there is.
TEST(Forged, WhatHasLeftIsForgottenAfterASecond) {
  for (const std::uint64_t step_us : {1'500 * kMs, kHourUs, kLastClockUs}) {
    for (const std::uint32_t run : {1U, 2U}) {
      Target target;
      target.drive(100);
      for (std::uint64_t i = 1; i <= (step_us == kLastClockUs ? 1 : 20); ++i) {
        const std::uint64_t clock_us = kStartUs + target.now_us + i * step_us;
        target.forge_three(std::min(clock_us, kLastClockUs), run);
      }
      target.expect_truth_again();
    }
  }
}

// Nothing was known before it came.
TEST(Forged, AFirstRunGivesWayToTheTrueOne) {
  for (const std::uint64_t clock_us : {std::uint64_t{kPeriodUs * 2}, kLastClockUs}) {
    for (const std::uint32_t run : {1U, 2U}) {
      Target target;
      target.forge_three(clock_us, run);
      target.expect_truth_again();
    }
  }
}

// One message of a run that waits for its third does not keep the run waiting.
TEST(Forged, AClockOfTheFutureDoesNotHoldUpANewRun) {
  for (const std::uint64_t ahead_us : {100 * kMs, 900 * kMs, kHourUs}) {
    Target target;
    target.drive(100);
    static_cast<void>(target.forge(kStartUs + target.now_us + ahead_us, 2));
    target.drive(101 + kConfirmations, 2);
    EXPECT_TRUE(target.is_at_truth());
    EXPECT_EQ(target.history.newest().value_or(Message{}).run, 2U);
  }
}

// As long as two talk at once nobody can say who is right: the later run holds.
TEST(Forged, AReplacedRunWaitsUntilTheOtherOneIsSilent) {
  Target target;
  target.drive(100);
  std::uint64_t clock_us = kHourUs;
  target.forge_three(clock_us, 2);
  for (int i = 0; i < 300; ++i) {
    target.drive(1);
    ASSERT_EQ(target.take(message_at(kStartUs + target.now_us)), Fate::kPastRun);
    ASSERT_EQ(target.forge(clock_us += kPeriodUs, 2), Fate::kUsed);
  }
  EXPECT_EQ(target.drive(101), 0);
  EXPECT_EQ(target.drive(kConfirmations), 2) << "the third message, and the next";
  EXPECT_TRUE(target.is_at_truth());
  EXPECT_EQ(target.history.breaks(Cause::kRestart).times, 2U);
}

// Within one run: its course was lost, and another begins.
TEST(Forged, ACourseThatIsReplacedWithinItsRunIsLost) {
  Target target;
  target.drive(100);
  target.forge_three(kStartUs + kHourUs, 1);
  EXPECT_EQ(target.history.breaks(Cause::kLost).times, 1U);
  EXPECT_EQ(target.history.breaks(Cause::kLost).since_us, kStartUs + target.now_us - 1 * kMs);
  target.drive(101 + kConfirmations);
  EXPECT_EQ(target.history.breaks(Cause::kLost).times, 2U);
  EXPECT_EQ(target.history.breaks(Cause::kLost).since_us, kStartUs + kHourUs);
  EXPECT_EQ(target.history.breaks(Cause::kRestart).times, 0U);
}

// A drive that is played faster or slower than it was recorded leaps nowhere: clocks are compared
// from one message to the next.
TEST(Forged, APaceIsNoLeap) {
  for (const std::uint64_t target_period_us : {std::uint64_t{100}, 1 * kMs, 90 * kMs, 900 * kMs}) {
    for (const std::uint64_t source_period_us : {10 * kMs, 100 * kMs, 1'000 * kMs}) {
      History history;
      int used = 0;
      for (std::uint64_t i = 0; i < 1'000; ++i) {
        const Message message = message_at(kStartUs + i * source_period_us);
        used += history.add(message, i * target_period_us) == Fate::kUsed ? 1 : 0;
      }
      EXPECT_EQ(used, 998);
      EXPECT_EQ(history.epoch(), 0U);
    }
  }
}

// A tunnel: the source says nothing for a minute, and its clock goes on as the target's does.
TEST(Forged, ALongSilenceIsNoLeap) {
  Target target;
  target.drive(100);
  target.now_us += 60'000 * kMs;
  EXPECT_EQ(target.drive(10), 10);
  EXPECT_TRUE(target.is_at_truth());
}

}  // namespace
}  // namespace iog::pose
