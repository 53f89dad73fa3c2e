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
