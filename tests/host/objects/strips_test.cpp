// What is near is never ruled out.
#include "objects/strips.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::objects {
namespace {

using iog::tests::effort;
using iog::tests::Random;

Bounds random_bounds(Random& random, Point around) {
  const Point low{around.x_mm + random.between(-6'000, 6'000),
                  around.y_mm + random.between(-6'000, 6'000)};
  const std::int32_t longest = random.one_in(20) ? 60'000 : 5'000;
  return {.low = low,
          .high = {low.x_mm + random.between(0, longest), low.y_mm + random.between(0, longest)}};
}

TEST(Strips, MeetWhereRectanglesAreNear) {
  Random random(5);
  int near = 0;
  int ruled_out = 0;
  for (int i = 0; i < effort(50'000, 2'000); ++i) {
    const Point around{random.between(-1'000'000'000, 1'000'000'000),
                       random.between(-1'000'000'000, 1'000'000'000)};
    const Bounds one = random_bounds(random, around);
    const Bounds other = random_bounds(random, around);
    const std::int32_t half_mm = random.between(0, 1'000);
    const bool meet = Strips::of(one, half_mm).may_meet(Strips::of(other, half_mm));
    if (one.is_near(other, 2 * half_mm)) {
      ASSERT_TRUE(meet) << i;
      ++near;
    }
    ruled_out += meet ? 0 : 1;
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(ruled_out, 100);
}

TEST(Strips, TheNextIsTheFirstThatMayMeet) {
  Random random(6);
  StripsOfAll all;
  for (std::size_t number = 0; number < kMostTracks; ++number) {
    all.set(number, Strips::of(random_bounds(random, {0, 0}), 0));
  }
  for (std::size_t number = 0; number < kMostTracks; ++number) {
    std::size_t from = 0;
    for (std::size_t other = 0; other < kMostTracks; ++other) {
      if (all[number].may_meet(all[other])) {
        ASSERT_EQ(all.next(all[number], from, kMostTracks), other);
        from = other + 1;
      }
    }
    ASSERT_EQ(all.next(all[number], from, kMostTracks), kMostTracks);
  }
}

}  // namespace
}  // namespace iog::objects
