// The phases of a server: one wait of 10 to 100 ms, then 100, 200 and 400 ms, then one a second.
#include "discovery/offer_schedule.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "discovery/answer_budget.hpp"

namespace iog::discovery {
namespace {

constexpr std::uint64_t kBeginUs = 5'000'000;

std::vector<std::uint64_t> offers(std::uint32_t noise, std::uint64_t step_us,
                                  std::uint64_t until_us) {
  OfferSchedule schedule(noise);
  std::vector<std::uint64_t> times;
  for (std::uint64_t now_us = kBeginUs; now_us <= kBeginUs + until_us; now_us += step_us) {
    EXPECT_EQ(schedule.is_waiting(), times.empty());
    if (schedule.take_due(now_us)) {
      times.push_back(now_us - kBeginUs);
    }
  }
  return times;
}

TEST(OfferSchedule, GoesThroughItsPhases) {
  EXPECT_EQ(offers(0, 1000, 3'000'000),
            (std::vector<std::uint64_t>{10'000, 110'000, 310'000, 710'000, 1'710'000, 2'710'000}));
}

TEST(OfferSchedule, BeginsWithinTheBoundsOfItsFirstDelay) {
  for (std::uint32_t noise = 0; noise < 0xF000'0000; noise += 0x0F21'4321) {
    const auto times = offers(noise, 10, 100'000);
    ASSERT_EQ(times.size(), 1U);
    ASSERT_GE(times[0], kInitialDelayMinUs);
  }
  EXPECT_GT(offers(0xFFFF'FFFF, 10, 100'000).at(0), 99'000U);
}

TEST(OfferSchedule, MakesUpForNothing) {
  OfferSchedule schedule(0);
  static_cast<void>(schedule.take_due(0));
  EXPECT_TRUE(schedule.take_due(60'000'000));
  EXPECT_FALSE(schedule.take_due(60'000'000));
  EXPECT_FALSE(schedule.take_due(60'099'999));
  EXPECT_TRUE(schedule.take_due(60'100'000));
}

TEST(AnswerBudget, GivesEightAtOnceAndTenASecond) {
  AnswerBudget budget;
  unsigned taken = 0;
  for (std::uint64_t now_us = kBeginUs; now_us < kBeginUs + 10'000'000; now_us += 100) {
    taken += budget.take(now_us) ? 1U : 0U;
  }
  EXPECT_EQ(taken, AnswerBudget::kBurst + 99);
  EXPECT_TRUE(budget.take(kBeginUs + 3'600'000'000));
}

}  // namespace
}  // namespace iog::discovery
