// What is near is never ruled out.
#include "objects/strips.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::objects {
namespace {

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
  for (int i = 0; i < iog::tests::effort(50'000, 2'000); ++i) {
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

TEST(PlacedTracks, TheNextIsTheFirstOfThoseAskedForThatMayMeet) {
  Random random(6);
  const auto tracks = std::make_unique<Tracks>();
  std::vector<std::size_t> asked;  // slots
  for (std::size_t slot = 0; slot < kMostTracks; ++slot) {
    const Bounds bounds = random_bounds(random, {0, 0});
    const Point middle = bounds.middle();
    const Box box{.at = middle,
                  .sides = {{{bounds.low.x_mm - middle.x_mm, bounds.high.x_mm - middle.x_mm},
                             {bounds.low.y_mm - middle.y_mm, bounds.high.y_mm - middle.y_mm}}}};
    (*tracks)[slot].begin(static_cast<std::uint32_t>(slot + 1), box, 1);
    if (random.one_in(3)) {
      (*tracks)[slot].end();
    } else {
      asked.push_back(slot);
    }
  }
  const PlacedTracks all(*tracks, 0, [](const Track& track) { return track.is_there(); });
  ASSERT_EQ(all.count(), asked.size());
  for (std::size_t number = 0; number < asked.size(); ++number) {
    ASSERT_EQ(all.slot(number), asked[number]);
    const Strips strips = Strips::of(bounds_of((*tracks)[asked[number]].box()), 0);
    std::size_t from = 0;
    for (std::size_t other = 0; other < asked.size(); ++other) {
      if (strips.may_meet(Strips::of(bounds_of((*tracks)[asked[other]].box()), 0))) {
        ASSERT_EQ(all.next(strips, from), other);
        from = other + 1;
      }
    }
    ASSERT_EQ(all.next(strips, from), all.count());
  }
}

}  // namespace
}  // namespace iog::objects
