// Runs of the source: which are believed, and from when on.
#include <gtest/gtest.h>

#include "pose/drive.hpp"

namespace iog::pose {
namespace {

using testing::Driven;
using testing::message_at;

constexpr std::uint64_t kMs = 1'000;

// The message of a run whose clock began at 0 and which stands at x = 7 m.
Message of_run(std::uint32_t run, std::uint64_t number) {
  Message message = message_at(testing::kStartUs, run);
  message.clock_us = 20 * kMs + number * 10 * kMs;
  message.pose.x_mm = 7'000;
  message.speed_mm_per_s = 0;
  return message;
}

TEST(Run, TheFirstIsBelievedWithItsThirdMessage) {
  Driven driven(0);
  EXPECT_EQ(driven.take(of_run(9, 0)), Fate::kUnconfirmed);
  EXPECT_EQ(driven.take(of_run(9, 1)), Fate::kUnconfirmed);
  EXPECT_EQ(driven.cause_at(30 * kMs), Cause::kLost);
  EXPECT_EQ(driven.history.newest(), std::nullopt);
  EXPECT_EQ(driven.take(of_run(9, 2)), Fate::kUsed);
  EXPECT_EQ(driven.cause_at(20 * kMs), Cause::kNone) << "the first two count as well";
  EXPECT_EQ(driven.cause_at(20 * kMs - 1), Cause::kLost);
  EXPECT_EQ(driven.history.breaks(Cause::kRestart).times, 0U) << "a start is no restart";
}

TEST(Run, ANewOneReplacesTheOldWithItsThirdMessage) {
  Driven driven;
  EXPECT_EQ(driven.take(of_run(2, 0)), Fate::kUnconfirmed);
  EXPECT_EQ(driven.take(of_run(2, 1)), Fate::kUnconfirmed);
  EXPECT_EQ(driven.cause_at(driven.newest_us), Cause::kNone) << "until then the old one holds";
  EXPECT_EQ(driven.history.epoch(), 0U);
  EXPECT_EQ(driven.take(of_run(2, 2)), Fate::kUsed);
  EXPECT_EQ(driven.history.epoch(), 1U);
  EXPECT_EQ(driven.history.breaks(Cause::kRestart).times, 1U);
  EXPECT_EQ(driven.history.breaks(Cause::kRestart).since_us, 20 * kMs);
  EXPECT_EQ(driven.history.pose_at(25 * kMs).pose.x_mm, 7'000);
  EXPECT_EQ(driven.cause_at(20 * kMs - 1), Cause::kRestart);
  EXPECT_EQ(driven.cause_at(driven.newest_us), Cause::kLate) << "a time of the old clock";
}

// Late repetitions of the old run, after the new one is believed.
TEST(Run, APastOneIsNotHeardWhileThePresentOneSpeaks) {
  Driven driven;
  const std::uint64_t now_us = driven.newest_us;
  for (std::uint64_t i = 0; i < 3; ++i) {
    static_cast<void>(driven.history.add(of_run(2, i), now_us));
  }
  for (std::uint64_t i = 1; i <= 100; ++i) {
    ASSERT_EQ(driven.history.add(message_at(now_us + i * 10 * kMs), now_us + i * 10 * kMs),
              Fate::kPastRun);
  }
  EXPECT_EQ(driven.history.epoch(), 1U);
  EXPECT_EQ(driven.history.add(of_run(2, 3), now_us + 1'000 * kMs), Fate::kUsed);
}

// Who was taken for gone, and is not.
TEST(Run, APastOneComesBackAfterASecondOfSilence) {
  Driven driven;
  const std::uint64_t silent_us = driven.newest_us + 1'000 * kMs;
  for (std::uint64_t i = 0; i < 3; ++i) {
    static_cast<void>(driven.history.add(of_run(2, i), driven.newest_us));
  }
  EXPECT_EQ(driven.history.add(message_at(silent_us), silent_us), Fate::kPastRun);
  for (std::uint64_t i = 1; i <= 3; ++i) {
    const Message message = message_at(silent_us + i * 10 * kMs);
    EXPECT_EQ(driven.history.add(message, message.clock_us),
              i < 3 ? Fate::kUnconfirmed : Fate::kUsed);
  }
  EXPECT_EQ(driven.history.epoch(), 2U);
  EXPECT_EQ(driven.history.breaks(Cause::kRestart).times, 2U);
}

TEST(Run, NothingIsConfirmedWhileThePresentOneGoesOn) {
  Driven driven;
  for (std::uint64_t i = 1; i <= 20; ++i) {
    EXPECT_EQ(driven.take(of_run(2, 2 * i)), Fate::kUnconfirmed);
    EXPECT_EQ(driven.take(of_run(2, 2 * i + 1)), Fate::kUnconfirmed);
    EXPECT_EQ(driven.take_at(driven.newest_us + i * 10 * kMs), Fate::kUsed);
  }
  EXPECT_EQ(driven.history.epoch(), 0U);
}

TEST(Run, TwoUnknownOnesDoNotConfirmEachOther) {
  Driven driven;
  for (std::uint64_t i = 0; i < 20; ++i) {
    ASSERT_EQ(driven.take(of_run(i % 2 == 0 ? 2 : 3, i)), Fate::kUnconfirmed);
  }
  EXPECT_EQ(driven.history.epoch(), 0U);
}

// What is dropped interrupts nothing: repetitions of the present run, and of the new one.
TEST(Run, DroppedMessagesDoNotInterruptARow) {
  Driven driven;
  EXPECT_EQ(driven.take(of_run(2, 0)), Fate::kUnconfirmed);
  EXPECT_EQ(driven.take_at(driven.newest_us), Fate::kNotNewer);
  EXPECT_EQ(driven.take(of_run(2, 0)), Fate::kNotNewer);
  EXPECT_EQ(driven.take(of_run(2, 1)), Fate::kUnconfirmed);
  EXPECT_EQ(driven.take(of_run(2, 0)), Fate::kNotNewer);
  Message close = of_run(2, 1);
  close.clock_us += 1 * kMs;
  EXPECT_EQ(driven.take(close), Fate::kFlood);
  EXPECT_EQ(driven.take(of_run(2, 2)), Fate::kUsed);
}

TEST(Run, MessagesMoreThanASecondApartAreNotARow) {
  Driven driven;
  EXPECT_EQ(driven.take(of_run(2, 0)), Fate::kUnconfirmed);
  EXPECT_EQ(driven.take(of_run(2, 1)), Fate::kUnconfirmed);
  EXPECT_EQ(driven.take(of_run(2, 102)), Fate::kUnconfirmed) << "1.01 s later: again the first";
  EXPECT_EQ(driven.take(of_run(2, 103)), Fate::kUnconfirmed);
  EXPECT_EQ(driven.take(of_run(2, 203)), Fate::kUsed) << "1 s later";
}

// A jump among the three shows like any other.
TEST(Run, ItsFirstMessagesAreHeldAgainstEachOther) {
  Driven driven;
  Message elsewhere = of_run(2, 1);
  elsewhere.pose.x_mm += 1'000;
  static_cast<void>(driven.take(of_run(2, 0)));
  static_cast<void>(driven.take(elsewhere));
  EXPECT_EQ(driven.take(of_run(2, 2)), Fate::kUsed);
  EXPECT_EQ(driven.history.breaks(Cause::kJump).times, 2U) << "there and back";
  EXPECT_EQ(driven.cause_at(of_run(2, 2).clock_us - 1), Cause::kJump);
}

// Fifteen past ones are remembered, besides the present one.
TEST(Run, ManyRunsInARowAreAllPast) {
  Driven driven;
  for (std::uint32_t run = 2; run <= 16; ++run) {
    for (std::uint64_t i = 0; i < 3; ++i) {
      static_cast<void>(driven.take(of_run(run, i)));
    }
    ASSERT_EQ(driven.history.newest().value_or(Message{}).run, run);
    for (std::uint32_t past = 1; past < run; ++past) {
      ASSERT_EQ(driven.take(of_run(past, 9)), Fate::kPastRun);
    }
  }
  EXPECT_EQ(driven.history.breaks(Cause::kRestart).times, 15U);
}

}  // namespace
}  // namespace iog::pose
