// The laws of the budget: never more than a burst, never faster than the line, nothing lost by
// asking often.
#include "serial/line_budget.hpp"

#include <array>
#include <gtest/gtest.h>

namespace iog::serial {
namespace {

constexpr std::uint32_t kRate = 11'520;  // bytes a second at 115200 baud

TEST(LineBudget, KeepsTheRateHoweverOftenItIsAsked) {
  for (const std::uint32_t step_us : {1u, 7u, 87u, 999u, 1000u, 7000u, 22'000u}) {
    LineBudget budget;
    std::uint64_t sent = 0;
    std::uint64_t now_us = 0;
    for (; now_us < 2'000'000; now_us += step_us) {
      budget.advance(now_us, kRate);
      ASSERT_LE(budget.bytes(), LineBudget::burst_bytes(kRate));
      sent += budget.bytes();
      budget.spend(budget.bytes());
    }
    const std::uint64_t carried = (now_us - step_us) * kRate / 1'000'000;
    EXPECT_LE(sent, carried + LineBudget::burst_bytes(kRate)) << step_us;
    EXPECT_GE(sent + 1, carried) << step_us;
  }
}

// 40 ms of 115200 baud, ten bits a byte.
TEST(LineBudget, IsAFramePeriodAheadOfTheLineAtMost) {
  EXPECT_EQ(LineBudget::burst_bytes(kRate), 460u);
}

TEST(LineBudget, ALongSilenceBuysOneBurstNotMore) {
  for (const std::uint32_t rate : std::array<std::uint32_t, 2>{kRate, 92'160}) {
    LineBudget budget;
    budget.advance(1'000'000'000'000, rate);
    EXPECT_EQ(budget.bytes(), LineBudget::burst_bytes(rate));
    budget.spend(budget.bytes());
    budget.advance(1'000'000'000'000, rate);
    EXPECT_EQ(budget.bytes(), 0u);
  }
}

}  // namespace
}  // namespace iog::serial
