// Who is late, against the plain rule, for schedules that are drawn.
#include "health/supervision.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::health {
namespace {

constexpr Supervision<3>::Checkpoints kThree{{{.name = "one", .window_us = 100},
                                              {.name = "two", .window_us = 0},
                                              {.name = "three", .window_us = 1'000'000}}};

TEST(Supervision, NobodyIsLateBeforeHisWindowHasPassed) {
  const Supervision<3> supervision(kThree, 50);
  EXPECT_EQ(supervision.late(50), 0U);
  EXPECT_EQ(supervision.late(51), 0b010U);
  EXPECT_EQ(supervision.late(150), 0b010U);
  EXPECT_EQ(supervision.late(151), 0b011U);
  EXPECT_EQ(supervision.late(1'000'051), 0b111U);
}

TEST(Supervision, WhoShowsThatHeLivesIsLateNoMore) {
  Supervision<3> supervision(kThree, 0);
  supervision.lives(0, 500);
  EXPECT_EQ(supervision.late(600), 0b010U) << "and nobody else with him";
  EXPECT_EQ(supervision.late(601), 0b011U);
}

TEST(Supervision, TheFirstOfSeveralHasItsName) {
  const Supervision<3> supervision(kThree, 0);
  EXPECT_EQ(supervision.name_of_first(0b001), "one");
  EXPECT_EQ(supervision.name_of_first(0b110), "two");
  EXPECT_EQ(supervision.name_of_first(0b100), "three");
}

// Signs and questions at drawn times: a checkpoint is late if its last sign, or the start, is
// longer ago than its window.
TEST(Supervision, IsThePlainRuleForDrawnSchedules) {
  tests::Random random(32);
  for (int schedule = 0; schedule < 200; ++schedule) {
    Supervision<8>::Checkpoints checkpoints;
    for (Checkpoint& checkpoint : checkpoints) {
      checkpoint = {.name = "drawn", .window_us = random.below(2000)};
    }
    std::uint64_t now_us = random.next() >> 8;
    Supervision<8> supervision(checkpoints, now_us);
    std::array<std::uint64_t, 8> last_us{};
    last_us.fill(now_us);
    for (int step = 0; step < 500; ++step) {
      now_us += random.below(300);
      const std::size_t who = random.below(8);
      if (!random.one_in(3)) {
        supervision.lives(who, now_us);
        last_us.at(who) = now_us;
      }
      for (std::size_t i = 0; i < 8; ++i) {
        const bool is_late = last_us.at(i) + checkpoints.at(i).window_us < now_us;
        ASSERT_EQ((supervision.late(now_us) >> i & 1U) != 0, is_late);
      }
    }
  }
}

}  // namespace
}  // namespace iog::health
