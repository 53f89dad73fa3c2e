// The window's time goes on by the clock of the poses, never back, and nobody takes it far ahead
// (docs/perception.md). Frames are of 40 ms; the target's clock is another one than that of the
// poses.
#include "perception/window_clock.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::perception {
namespace {

constexpr std::uint64_t kFrameTookUs = 40'000;
constexpr std::uint64_t kSecondUs = 1'000'000;
constexpr std::uint64_t kStartUs = 1'700'000'000 * kSecondUs;  // of the poses' clock
constexpr std::uint64_t kNowUs = 5 * kSecondUs;                // of the target's

TEST(EndOfFrame, IsThatOfItsLastSlice) {
  EXPECT_EQ(end_of_frame(kStartUs + 8'000, kStartUs + 10'000, kStartUs), kStartUs + 8'000);
}

TEST(EndOfFrame, WithoutASliceIsTheNewestPose) {
  EXPECT_EQ(end_of_frame(std::nullopt, kStartUs + 500'000, kStartUs), kStartUs);
}

// At most 100 ms ahead of the poses' clock, and at most a second behind the newest pose.
TEST(EndOfFrame, IsNearThePosesWhateverAScannersClockSays) {
  EXPECT_EQ(end_of_frame(kStartUs + 3600 * kSecondUs, kStartUs + 10'000, kStartUs),
            kStartUs + 110'000);
  EXPECT_EQ(end_of_frame(kStartUs - 3600 * kSecondUs, kStartUs + 10'000, kStartUs),
            kStartUs - kSecondUs);
  EXPECT_EQ(end_of_frame(0, 10'000, 20'000), 0U);
}

// A clock that frames are ended with, one after the other.
struct Frames {
  std::uint64_t now_us = kNowUs;
  WindowClock clock;

  Frames() { clock.start(now_us); }
  // The frame takes so long by the target's clock.
  std::uint64_t end(std::optional<std::uint64_t> time_us, bool is_anew = false,
                    std::uint64_t took_us = kFrameTookUs) {
    now_us += took_us;
    clock.end_frame(time_us, is_anew, now_us);
    return clock.stamp_us();
  }
};

TEST(WindowClock, BeginsWithTheFirstClockOfThePoses) {
  Frames frames;
  EXPECT_EQ(frames.end(std::nullopt), kFrameTookUs);
  EXPECT_EQ(frames.end(std::nullopt), 2 * kFrameTookUs);
  EXPECT_EQ(frames.end(kStartUs), kStartUs);
  EXPECT_EQ(frames.end(kStartUs + 39'000), kStartUs + 39'000);
}

TEST(WindowClock, GoesOnByTheTargetsClockWhereThatOfThePosesIsNotKnown) {
  Frames frames;
  frames.end(kStartUs);
  EXPECT_EQ(frames.end(std::nullopt), kStartUs + kFrameTookUs);
  EXPECT_EQ(frames.end(std::nullopt, false, 7 * kFrameTookUs), kStartUs + 8 * kFrameTookUs);
  // It is known again, and went on as well.
  EXPECT_EQ(frames.end(kStartUs + 9 * kFrameTookUs), kStartUs + 9 * kFrameTookUs);
}

// Slices of a frame may end before those of the frame before.
TEST(WindowClock, WaitsForAFrameThatEndsEarlier) {
  Frames frames;
  frames.end(kStartUs);
  EXPECT_EQ(frames.end(kStartUs - 16'000), kStartUs);
  EXPECT_EQ(frames.end(kStartUs + 30'000), kStartUs + 30'000);
}

// The clock of other poses takes up where time is, and is followed from there.
TEST(WindowClock, AClockThatBeginsAnewTakesUpWhereTimeIs) {
  Frames frames;
  frames.end(kStartUs);
  EXPECT_EQ(frames.end(1'000, true), kStartUs + kFrameTookUs);
  EXPECT_EQ(frames.end(1'000 + 35'000), kStartUs + kFrameTookUs + 35'000);
  // So does one that has not been known for a while, though poses are the same.
  frames.end(std::nullopt);
  EXPECT_EQ(frames.end(1'000), kStartUs + kFrameTookUs + 35'000 + 2 * kFrameTookUs);
}

// Two seconds more than have passed by the target's clock are believed: a drive may be played fast.
TEST(WindowClock, ALeapIsNotFollowed) {
  Frames frames;
  frames.end(kStartUs);
  EXPECT_EQ(frames.end(kStartUs + kFrameTookUs + 2 * kSecondUs),
            kStartUs + kFrameTookUs + 2 * kSecondUs);
  const std::uint64_t before_us = frames.clock.stamp_us();
  EXPECT_EQ(frames.end(before_us + kFrameTookUs + 2 * kSecondUs + 1), before_us + kFrameTookUs);
}

// Whatever clocks say: time does not go back, does not run away, and where no clock is known it is
// the target's.
TEST(WindowClock, NeverGoesBackOrFarAhead) {
  tests::Random random(17);
  for (int drive = 0; drive < tests::effort(300, 40); ++drive) {
    Frames frames;
    frames.end(kStartUs);
    std::uint64_t moved_us = frames.now_us;
    for (int frame = 0; frame < 100; ++frame) {
      const std::uint64_t before_us = frames.clock.stamp_us();
      std::optional<std::uint64_t> time_us;
      if (!random.one_in(3)) {
        const std::uint64_t far_us = std::uint64_t{1} << random.between(0, 62);
        time_us = random.one_in(2) ? kStartUs + far_us % (3'600 * kSecondUs) : far_us;
      }
      const std::uint64_t took_us = random.below(100'000);
      const std::uint64_t stamp_us = frames.end(time_us, random.one_in(5), took_us);
      const std::uint64_t passed_us = frames.now_us - moved_us;
      ASSERT_GE(stamp_us, before_us);
      ASSERT_LE(stamp_us - before_us, passed_us + 2 * kSecondUs);
      if (!time_us) {
        ASSERT_EQ(stamp_us - before_us, passed_us);
      }
      moved_us = stamp_us > before_us ? frames.now_us : moved_us;
    }
  }
}

}  // namespace
}  // namespace iog::perception
