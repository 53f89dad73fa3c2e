// Poses that come later and later, of a car whose packets are placed by when they come.
#include <functional>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "pose/drive.hpp"

namespace iog::pose {
namespace {

using testing::kStartUs;
using testing::message_at;

constexpr std::uint64_t kMs = 1'000;
constexpr std::uint64_t kSecondUs = 1'000'000;
// What delays a message, by the time since the begin.
using Delay = std::function<std::uint64_t(std::uint64_t)>;

// When each message was placed by: nothing by a history that says `drifting` then.
struct Delayed {
  explicit Delayed(const Delay& delay, std::uint64_t seconds, bool depends_on_arrival = true,
                   std::uint64_t period_us = 10 * kMs)
      : history(depends_on_arrival) {
    for (std::uint64_t since_us = 0; since_us <= seconds * kSecondUs; since_us += period_us) {
      const std::uint64_t clock_us = kStartUs + since_us;
      EXPECT_NE(history.add(message_at(clock_us), clock_us + delay(since_us)), Fate::kNotNewer);
      const Placed placed = history.pose_at(clock_us);
      const bool is_told = placed.cause == Cause::kDrifting;
      EXPECT_TRUE(is_told || placed.has_pose() || since_us < 2 * period_us) << since_us;
      first_us = is_told && first_us == 0 ? since_us : first_us;
      last_us = is_told ? since_us : last_us;
    }
  }
  [[nodiscard]] std::uint32_t times() const { return history.breaks(Cause::kDrifting).times; }

  History history;
  std::uint64_t first_us = 0;
  std::uint64_t last_us = 0;
};

// 8 % is 80 ms in the second whose least offset places a packet, so no slice is ever late.
TEST(Drift, PosesHeldBackMoreAndMoreAreTold) {
  const Delay held = [](std::uint64_t since_us) { return 2 * kMs + since_us * 8 / 100; };
  const Delayed run(held, 10);
  EXPECT_EQ(run.times(), 1U);
  EXPECT_LE(run.first_us, kSecondUs + 400 * kMs) << "30 ms of growth, and the second";
  EXPECT_EQ(run.last_us, 10 * kSecondUs) << "as long as it goes on";
  EXPECT_EQ(run.history.epoch(), 1U) << "what was placed is unknown";
  EXPECT_EQ(run.history.source_time(kStartUs), std::nullopt);
  EXPECT_EQ(run.history.breaks(Cause::kDrifting).since_us, kStartUs + run.first_us);
}

TEST(Drift, SlowerThanThatToo) {
  for (const std::uint64_t per_mille : {1U, 5U, 20U, 300U}) {
    const Delay held = [&](std::uint64_t since_us) { return since_us * per_mille / 1'000; };
    const Delayed run(held, 60);
    EXPECT_GE(run.times(), 1U) << per_mille;
    EXPECT_LE((run.first_us - kSecondUs) * per_mille / 1'000 - run.first_us / 5'000, 36 * kMs);
  }
}

// Crystals are off by up to 100 ppm each; messages wait now and then for what is before them.
Delay clock_off_by(std::int64_t ppm) {
  return [ppm, random = tests::Random(7)](std::uint64_t since_us) mutable {
    const auto off_us = static_cast<std::int64_t>(since_us) * ppm / 1'000'000;
    return kSecondUs + static_cast<std::uint64_t>(off_us) + random.below(28'000);
  };
}

struct NoDrift {
  const char* what;
  Delay delay;
  std::uint64_t seconds;
  bool depends_on_arrival = true;
  std::uint64_t period_us = 10 * kMs;
};

TEST(Drift, IsNoneThatIsTold) {
  const Delay gains = [](std::uint64_t since_us) { return 20 * kSecondUs - since_us / 2; };
  const Delay jams = [](std::uint64_t since_us) {
    const std::uint64_t in_turn_us = since_us % (900 * kMs);
    return in_turn_us < 800 * kMs ? (800 * kMs - in_turn_us) / 4 : 0;
  };
  const Delay held = [](std::uint64_t since_us) { return since_us * 8 / 100; };
  for (const NoDrift& its :
       {NoDrift{"two crystals", clock_off_by(200), 1'800, true, 100 * kMs},
        {"one crystal", clock_off_by(100), 1'800, true, 100 * kMs},
        {"two crystals the other way", clock_off_by(-200), 1'800, true, 100 * kMs},
        {"a drive that is played twice as fast, so that the source's clock gains", gains, 30},
        {"a busy target or sender, but no whole second without a message in time", jams, 60},
        {"clocks of sensors place packets, and a pose that comes late is late", held, 10, false}}) {
    EXPECT_EQ(Delayed(its.delay, its.seconds, its.depends_on_arrival, its.period_us).times(), 0U)
        << its.what;
  }
}

// Whatever stood before, the window begins anew, and two seconds later poses are believed again.
TEST(Drift, ADelayThatStaysIsToldOnce) {
  const Delay stays = [](std::uint64_t since_us) {
    return since_us < 5 * kSecondUs ? 2 * kMs : 50 * kMs;
  };
  const Delayed run(stays, 20);
  EXPECT_EQ(run.times(), 1U);
  EXPECT_GE(run.first_us, 5 * kSecondUs);
  EXPECT_LE(run.last_us, 8 * kSecondUs + 20 * kMs);
}

// Somebody may send in the source's name: one message whose clock is ahead.
TEST(Drift, OneMessageThatIsAheadBlindsForNoLongerThanThat) {
  const Delay ahead = [](std::uint64_t since_us) {
    return 100 * kMs - (since_us == 3 * kSecondUs ? 90 * kMs : 0);
  };
  const Delayed run(ahead, 30);
  EXPECT_EQ(run.times(), 1U);
  EXPECT_LE(run.last_us - run.first_us, 2 * kSecondUs);
}

TEST(Drift, IsForgottenWithAnotherRun) {
  Delayed run([](std::uint64_t since_us) { return since_us * 8 / 100; }, 5);
  const std::uint64_t begin_us = kStartUs + 5 * kSecondUs;
  testing::go_on_as(run.history, 2, begin_us);
  EXPECT_TRUE(run.history.pose_at(begin_us + 30 * kMs).has_pose());
}

}  // namespace
}  // namespace iog::pose
