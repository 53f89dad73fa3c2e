// The pose of a time, and the causes why there is none.
#include "pose/history.hpp"

#include <gtest/gtest.h>

#include "pose/drive.hpp"

namespace iog::pose {
namespace {

using testing::drive;
using testing::Driven;
using testing::kStartUs;
using testing::message_at;

constexpr std::uint64_t kMs = 1'000;

// The car drives 10 mm a millisecond, so where it is tells what was asked.
void expect_x(const History& history, std::uint64_t time_us, std::int32_t x_mm) {
  const Placed placed = history.pose_at(time_us);
  ASSERT_EQ(placed.cause, Cause::kNone) << time_us;
  ASSERT_EQ(placed.pose, (Pose{x_mm, 0, 0})) << time_us;
}

TEST(PoseOfATime, LiesBetweenTwoMessages) {
  const Driven driven;
  for (std::uint64_t time_us = kStartUs; time_us <= driven.newest_us; time_us += 700) {
    const auto tenths = static_cast<std::int32_t>(time_us - kStartUs) / 10;  // of a millimetre
    expect_x(driven.history, time_us, (tenths + 5) / 10);
  }
}

TEST(PoseOfATime, IsMovedAheadOfTheNewestForATenthOfASecond) {
  const Driven driven;
  const std::int32_t newest_x = 490 * 10;
  expect_x(driven.history, driven.newest_us + 1 * kMs, newest_x + 10);
  expect_x(driven.history, driven.newest_us + 100 * kMs, newest_x + 1'000);
  EXPECT_EQ(driven.cause_at(driven.newest_us + 100 * kMs + 1), Cause::kLate);
}

TEST(PoseOfATime, IsNeverThatOfATimeBeforeTheFirstMessage) {
  const Driven driven;
  EXPECT_EQ(driven.cause_at(kStartUs - 1), Cause::kLost);
  EXPECT_EQ(driven.cause_at(0), Cause::kLost);
  EXPECT_EQ(History().pose_at(kStartUs).cause, Cause::kLost);
}

// In a gap only what is near one of its ends.
TEST(PoseOfATime, IsLateInTheMiddleOfAGap) {
  Driven driven;
  const std::uint64_t gap_end_us = driven.newest_us + 500 * kMs;
  ASSERT_EQ(driven.take_at(gap_end_us), Fate::kUsed);
  const std::int32_t newest_x = 490 * 10;
  expect_x(driven.history, driven.newest_us + 100 * kMs, newest_x + 1'000);
  EXPECT_EQ(driven.cause_at(driven.newest_us + 100 * kMs + 1), Cause::kLate);
  EXPECT_EQ(driven.cause_at(gap_end_us - 100 * kMs - 1), Cause::kLate);
  expect_x(driven.history, gap_end_us - 100 * kMs, newest_x + 4'000);
  EXPECT_EQ(driven.history.epoch(), 0U);
}

TEST(PoseOfATime, OfMoreThanASecondAgoIsThereForASourceOfAHundredHertz) {
  const Driven driven(1'000);
  expect_x(driven.history, driven.newest_us - 1'000 * kMs, (9'990 - 1'000) * 10);
  EXPECT_EQ(driven.cause_at(driven.newest_us - 1'270 * kMs), Cause::kNone);
  EXPECT_EQ(driven.cause_at(driven.newest_us - 1'270 * kMs - 1), Cause::kLate) << "overwritten";
}

// A pose that is not known is not stated, nor how well it is known.
TEST(PoseOfATime, ThatIsNotKnownIsNothing) {
  Driven driven;
  Message imprecise = message_at(driven.newest_us + 10 * kMs);
  imprecise.sigma = {151, 1};
  ASSERT_EQ(driven.take(imprecise), Fate::kUsed);
  for (std::uint64_t time_us = kStartUs - 50 * kMs; time_us < driven.newest_us + 1'500 * kMs;
       time_us += 9'700) {
    const Placed placed = driven.history.pose_at(time_us);
    if (!placed.has_pose()) {
      EXPECT_EQ(placed.pose, Pose{}) << time_us;
      EXPECT_EQ(placed.sigma, Sigma{}) << time_us;
    }
  }
}

struct SigmaCase {
  Sigma sigma;
  Cause cause;
};

// 150 mm; and 3 mrad, which are 150 mm at 50 m.
TEST(Imprecise, IsAboveOneHundredAndFiftyMillimetres) {
  for (const SigmaCase& expected : {SigmaCase{{150, 300}, Cause::kNone},
                                    {{151, 1}, Cause::kImprecise},
                                    {{1, 301}, Cause::kImprecise},
                                    {{0xFFFF, 1}, Cause::kImprecise},
                                    {{1, 0xFFFF}, Cause::kImprecise}}) {
    Driven driven;
    Message message = message_at(driven.newest_us + 10 * kMs);
    message.sigma = expected.sigma;
    ASSERT_EQ(driven.take(message), Fate::kUsed);
    EXPECT_EQ(driven.cause_at(message.clock_us + 50 * kMs), expected.cause) << "ahead of it";
    EXPECT_EQ(driven.cause_at(message.clock_us), expected.cause);
    EXPECT_EQ(driven.cause_at(message.clock_us - 1), expected.cause) << "on the way to it";
    EXPECT_EQ(driven.cause_at(driven.newest_us - 1), Cause::kNone) << "before that way";
    const Sigma larger{std::max<std::uint16_t>(10, expected.sigma.position_mm),
                       std::max<std::uint16_t>(10, expected.sigma.heading_10urad)};
    EXPECT_EQ(driven.history.pose_at(message.clock_us - 1).sigma,
              expected.cause == Cause::kNone ? larger : Sigma{});
    EXPECT_EQ(driven.history.epoch(), 0U) << "the window keeps what it has";
  }
}

TEST(Lost, IsASilenceOfMoreThanASecond) {
  Driven driven;
  driven.history.pass(driven.newest_us + 1'000 * kMs);
  EXPECT_EQ(driven.history.epoch(), 0U);
  EXPECT_EQ(driven.cause_at(driven.newest_us), Cause::kNone);
  driven.history.pass(driven.newest_us + 1'000 * kMs + 1);
  EXPECT_EQ(driven.history.epoch(), 1U);
  EXPECT_EQ(driven.cause_at(driven.newest_us), Cause::kLost);
  EXPECT_EQ(driven.history.breaks(Cause::kLost).times, 1U);
  EXPECT_EQ(driven.history.breaks(Cause::kLost).since_us, driven.newest_us);
  driven.history.pass(driven.newest_us + 9'000 * kMs);
  EXPECT_EQ(driven.history.epoch(), 1U) << "once";
}

TEST(Lost, TimeThatGoesBackLosesNothing) {
  Driven driven;
  driven.history.pass(0);
  EXPECT_EQ(driven.history.epoch(), 0U);
}

// The same silence, when nobody looked while it lasted.
TEST(Lost, ShowsWhenTheNextMessageComes) {
  for (const std::uint64_t silence_us : {1'000 * kMs, 1'000 * kMs + 1}) {
    Driven driven;
    const std::uint64_t again_us = driven.newest_us + silence_us;
    ASSERT_EQ(driven.take_at(again_us), Fate::kUsed);
    const bool is_lost = silence_us > 1'000 * kMs;
    EXPECT_EQ(driven.history.epoch(), is_lost ? 1U : 0U);
    EXPECT_EQ(driven.cause_at(again_us), Cause::kNone);
    EXPECT_EQ(driven.cause_at(again_us - 1), is_lost ? Cause::kLost : Cause::kNone);
  }
}

TEST(Lost, EndsWithTheNextMessageWhereverItIs) {
  Driven driven;
  driven.history.pass(driven.newest_us + 1'500 * kMs);
  Message message = message_at(driven.newest_us + 1'600 * kMs);
  message.pose = {.x_mm = -70'000'000, .y_mm = 5, .heading = 0x12345678};
  ASSERT_EQ(driven.take(message), Fate::kUsed);
  EXPECT_EQ(driven.history.pose_at(message.clock_us).pose, message.pose);
  EXPECT_EQ(driven.history.epoch(), 1U) << "no jump from a place that is lost";
}

// Whatever was placed has lost its place, and what the source says is not believed before it says
// that the car has moved: 10 mm a millisecond.
TEST(Contradicted, BreaksTheHistoryUntilThePoseHasMoved) {
  Driven driven;
  driven.history.contradict();
  EXPECT_EQ(driven.history.epoch(), 1U);
  EXPECT_EQ(driven.cause_at(driven.newest_us), Cause::kContradicted);
  EXPECT_EQ(driven.history.breaks(Cause::kContradicted).times, 1U);
  EXPECT_EQ(driven.history.breaks(Cause::kContradicted).since_us, driven.newest_us);
  driven.history.contradict();
  EXPECT_EQ(driven.history.epoch(), 1U) << "once";
  for (std::uint64_t i = 1; i <= 3; ++i) {
    ASSERT_EQ(driven.take_at(driven.newest_us + i * 10 * kMs), Fate::kUsed);
    EXPECT_EQ(driven.cause_at(driven.newest_us + i * 10 * kMs), Cause::kContradicted);
    EXPECT_EQ(driven.history.source_time(1), std::nullopt);
  }
  const std::uint64_t again_us = driven.newest_us + 40 * kMs;
  ASSERT_EQ(driven.take_at(again_us), Fate::kUsed);
  EXPECT_EQ(driven.cause_at(again_us), Cause::kNone);
  EXPECT_EQ(driven.cause_at(again_us - 1), Cause::kContradicted);
  EXPECT_EQ(driven.history.epoch(), 1U);
}

// A car may stand, too, and who contradicted it may have been a crowd that left.
TEST(Contradicted, IsForgivenAfterTenSeconds) {
  Driven driven;
  Message stuck = message_at(driven.newest_us);
  stuck.speed_mm_per_s = 0;
  driven.history.contradict();
  for (std::uint64_t i = 1; i <= 1'000; ++i) {
    stuck.clock_us = driven.newest_us + i * 10 * kMs;
    ASSERT_EQ(driven.take(stuck), Fate::kUsed);
    ASSERT_EQ(driven.cause_at(stuck.clock_us), Cause::kContradicted);
  }
  stuck.clock_us += 10 * kMs;
  ASSERT_EQ(driven.take(stuck), Fate::kUsed);
  EXPECT_EQ(driven.cause_at(stuck.clock_us), Cause::kNone);
}

// More than 300 mm, at 100 mm a message, since the first message of its run.
TEST(HasMoved, IsAskedOfARun) {
  Driven driven(4);
  EXPECT_FALSE(driven.history.has_moved());
  ASSERT_EQ(driven.take_at(driven.newest_us + 10 * kMs), Fate::kUsed);
  EXPECT_TRUE(driven.history.has_moved());
  testing::go_on_as(driven.history, 2, driven.newest_us);
  EXPECT_FALSE(driven.history.has_moved());
}

TEST(Contradicted, IsForgivenToAnotherRun) {
  Driven driven;
  driven.history.contradict();
  testing::go_on_as(driven.history, 2, driven.newest_us);
  EXPECT_EQ(driven.cause_at(driven.newest_us + 30 * kMs), Cause::kNone);
}

void expect_unchanged(const Driven& driven, const Driven& before) {
  for (std::uint64_t time_us = kStartUs - 20 * kMs; time_us < driven.newest_us + 120 * kMs;
       time_us += 3'300) {
    ASSERT_EQ(driven.history.pose_at(time_us), before.history.pose_at(time_us)) << time_us;
  }
  ASSERT_EQ(driven.history.epoch(), before.history.epoch());
  ASSERT_EQ(driven.history.newest(), before.history.newest());
  ASSERT_EQ(driven.history.source_time(9'000'000), before.history.source_time(9'000'000));
}

// Repeated and overtaken messages, however strange their poses.
TEST(NotNewer, ChangesNothing) {
  const Driven before;
  Driven driven;
  for (const std::uint64_t clock_us : {driven.newest_us, driven.newest_us - 1,
                                       driven.newest_us - 100 * kMs, kStartUs, std::uint64_t{0}}) {
    Message message = message_at(clock_us);
    message.pose.y_mm = 77'777;
    ASSERT_EQ(driven.history.add(message, 1), Fate::kNotNewer);
    expect_unchanged(driven, before);
  }
}

TEST(Flood, IsCloserThanEightMilliseconds) {
  const Driven before;
  Driven driven;
  for (std::uint64_t later_us = 1; later_us < 8 * kMs; later_us += 113) {
    Message message = message_at(driven.newest_us + later_us);
    message.pose.x_mm += 50'000;
    ASSERT_EQ(driven.take(message), Fate::kFlood);
  }
  expect_unchanged(driven, before);
  EXPECT_EQ(driven.take_at(driven.newest_us + 8 * kMs), Fate::kUsed);
}

// A source of 1 kHz is thinned out, and the second that is asked of the history is still there.
TEST(Flood, LeavesASecondOfPoses) {
  History history;
  const std::uint64_t end_us = kStartUs + 4'000 * kMs;
  int used = 0;
  for (std::uint64_t clock_us = kStartUs; clock_us <= end_us; clock_us += 1 * kMs) {
    used += history.add(message_at(clock_us), clock_us) == Fate::kUsed ? 1 : 0;
  }
  EXPECT_EQ(used, 4'000 / 8 + 1 - 2) << "two wait until the run is believed";
  for (std::uint64_t back_us = 0; back_us <= 1'000 * kMs; back_us += 900) {
    const auto x = static_cast<std::int32_t>((end_us - back_us - kStartUs) / 100);
    expect_x(history, end_us - back_us, x);
  }
}

// Clocks: the target began 100 s after the source; messages are under way for 2 to 9 ms.
TEST(SourceTime, IsThatOfTheLeastDelayedMessage) {
  History history;
  EXPECT_EQ(history.source_time(1), std::nullopt);
  constexpr std::uint64_t kBehindUs = 100'000'000;
  const std::uint64_t start_us = kStartUs + kBehindUs;
  for (std::uint64_t i = 0; i < 50; ++i) {
    Message message = message_at(start_us + i * 10 * kMs);
    message.pose = {};
    message.speed_mm_per_s = 0;
    message.age_us = static_cast<std::uint32_t>(30 * kMs);
    const std::uint64_t delay_us = (i == 20 ? 2 : 3 + i % 7) * kMs;
    static_cast<void>(
        history.add(message, message.clock_us - kBehindUs + message.age_us + delay_us));
  }
  EXPECT_EQ(history.source_time(6'000'000), 6'000'000 + kBehindUs - 2 * kMs);
  EXPECT_EQ(history.source_time(0), kBehindUs - 2 * kMs);
}

// A delay that nobody has seen for a second no longer counts: the clocks may have drifted.
TEST(SourceTime, ForgetsAfterASecond) {
  History history;
  for (std::uint64_t i = 0; i <= 110; ++i) {
    const Message message = message_at(kStartUs + i * 10 * kMs);
    const std::uint64_t delay_us = i <= 2 ? 1 * kMs : 5 * kMs;
    static_cast<void>(history.add(message, message.clock_us + delay_us));
    const bool still_knows = i < 103;
    if (i >= 2) {
      ASSERT_EQ(history.source_time(6'000'000), 6'000'000 - (still_knows ? 1 : 5) * kMs) << i;
    }
  }
}

TEST(SourceTime, NoZeroOfAClockMatters) {
  constexpr std::uint64_t kEnd = ~std::uint64_t{0};
  for (const std::uint64_t target_start : {std::uint64_t{0}, kEnd - 15 * kMs, kEnd / 2}) {
    for (const std::uint64_t source_start : {std::uint64_t{0}, kEnd - 25 * kMs, kEnd / 2}) {
      History history;
      for (std::uint64_t i = 0; i < 3; ++i) {
        Message message = message_at(kStartUs);
        message.clock_us = source_start + i * 10 * kMs;
        message.speed_mm_per_s = 0;
        ASSERT_LT(history.add(message, target_start + i * 10 * kMs), Fate::kStranger);
      }
      EXPECT_EQ(history.source_time(target_start + 7), source_start + 7);
    }
  }
}

}  // namespace
}  // namespace iog::pose
