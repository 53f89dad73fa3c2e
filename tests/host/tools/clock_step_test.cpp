#include "tools/identity/clock_step.hpp"

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

// Packets each 1.3 ms for 20 s, of a clock that is set at 10 s; arrivals wait up to `batch_us`.
std::optional<ClockStep::Found> found(std::int64_t set_us, std::uint64_t batch_us,
                                      std::uint64_t ppm = 0) {
  ClockStep step;
  for (std::uint64_t true_us = 0; true_us < 20'000'000; true_us += 1'300) {
    const std::uint64_t arrival_us = (true_us / batch_us + 1) * batch_us + true_us * 7 % 3'000;
    const bool is_lost = true_us / 2'000'000 % 3 == 1 && true_us % 7 != 0;
    const std::uint64_t own_us = true_us + true_us * ppm / 1'000'000;
    const std::int64_t ahead_us = static_cast<std::int64_t>(own_us) -
                                  static_cast<std::int64_t>(arrival_us) +
                                  (true_us > 10'000'000 ? set_us : 0);
    if (!is_lost) {
      step.add(ahead_us, arrival_us);
    }
  }
  return step.found();
}

TEST(ClockStep, AClockThatIsSetByLessThanASecondIsFound) {
  for (const std::int64_t set_us : {-900'000, -450'000, -150'000, 150'000, 450'000, 900'000}) {
    for (const std::uint64_t batch_us : {1'000U, 100'000U}) {
      const auto its = found(set_us, batch_us);
      ASSERT_TRUE(its) << set_us << " in batches of " << batch_us;
      EXPECT_NEAR(static_cast<double>(its->step_us), static_cast<double>(set_us), 20'000);
      EXPECT_NEAR(static_cast<double>(its->time_us), 1e7, 700'000);
    }
  }
}

TEST(ClockStep, JitterBatchesLossAndDriftAreNone) {
  for (const std::uint64_t batch_us : {1'000U, 100'000U, 200'000U}) {
    EXPECT_FALSE(found(0, batch_us));
    EXPECT_FALSE(found(50'000, batch_us));
    EXPECT_FALSE(found(0, batch_us, 20'000));
  }
}

// By a second, as of a leap second, or by a little more or less. In sparse packets, too.
TEST(ClockStep, AClockThatIsSetByASecondIsFound) {
  for (const std::int64_t set_us : {-1'001'000, -1'000'200, -1'000'000, 1'000'000, 1'000'200}) {
    for (const std::uint64_t period_us : {1'300U, 10'000U}) {
      for (std::uint64_t seed = 1; seed < 20; ++seed) {
        ClockStep step;
        for (std::uint64_t true_us = 0; true_us < 20'000'000; true_us += period_us) {
          const auto delay_us = static_cast<std::int64_t>(true_us * seed * 7 % 2'003);
          step.add((true_us > 10'000'000 ? set_us : 0) - delay_us,
                   true_us + static_cast<std::uint64_t>(delay_us));
        }
        ASSERT_TRUE(step.found()) << set_us << ' ' << period_us << ' ' << seed;
        EXPECT_NEAR(static_cast<double>(step.found()->step_us), static_cast<double>(set_us), 3'000);
      }
    }
  }
}

TEST(ClockStep, ADamagedPacketOrHoursOfDriftAreNone) {
  ClockStep damaged;
  ClockStep drifting;
  for (std::int64_t i = 0; i < 2'000; ++i) {
    damaged.add(i % 500 == 0 ? -5'000'000 : 0, static_cast<std::uint64_t>(i) * 10'000);
    drifting.add(i * 1'000, static_cast<std::uint64_t>(i) * 10'000'000);  // 100 ppm for 5 hours
  }
  EXPECT_FALSE(damaged.found());
  EXPECT_FALSE(drifting.found());
}

TEST(ClockStep, TakesAnyTimes) {
  ClockStep step;
  for (int i = 0; i < 100; ++i) {
    step.add(i % 2 == 0 ? INT64_MIN : INT64_MAX, i % 3 == 0 ? UINT64_MAX : 0);
  }
  EXPECT_FALSE(step.found());
}

// A recorder that stands still for a second, and then takes all that has waited.
TEST(ClockStep, APauseOfTheRecorderIsNone) {
  ClockStep step;
  for (std::uint64_t true_us = 0; true_us < 20'000'000; true_us += 1'300) {
    const bool has_waited = true_us > 9'000'000 && true_us < 10'000'000;
    const std::uint64_t arrival_us = has_waited ? 10'000'000 : true_us;
    step.add(static_cast<std::int64_t>(true_us) - static_cast<std::int64_t>(arrival_us),
             arrival_us);
  }
  EXPECT_FALSE(step.found());
}

}  // namespace
}  // namespace iog::tools
