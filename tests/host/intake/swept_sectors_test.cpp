#include "intake/swept_sectors.hpp"

#include <gtest/gtest.h>
#include <set>

#include "fakes/random.hpp"

namespace iog::intake {
namespace {

// Against a set of ticks: random sectors, also across the end of the turn and of a whole turn.
TEST(SweptSectors, CountsEachTickOnce) {
  tests::Random random(1);
  for (const int turn : {11'520, 36'000, 1'000}) {
    SweptSectors swept(static_cast<std::uint32_t>(turn));
    std::set<int> ticks;
    for (int i = 0; i < 60; ++i) {
      const int width = random.one_in(20) ? turn : random.between(0, random.one_in(2) ? 40 : 700);
      const int first = random.between(0, turn - 1);
      const lidar::Sector sector{static_cast<std::uint16_t>(first),
                                 static_cast<std::uint16_t>(width)};
      const std::size_t before = ticks.size();
      for (int tick = first; tick < first + width; ++tick) {
        ticks.insert(tick % turn);
      }
      const auto missing = static_cast<std::uint32_t>(ticks.size() - before);
      EXPECT_FALSE(swept.misses_more_than(missing, sector));
      EXPECT_EQ(missing > 0, swept.misses_more_than(missing - (missing > 0 ? 1 : 0), sector));
      swept.add(sector);
      EXPECT_EQ(swept.count(), ticks.size());
      EXPECT_FALSE(swept.misses_more_than(0, sector));
      if (ticks.size() == static_cast<std::size_t>(turn)) {
        swept.clear();
        ticks.clear();
        EXPECT_EQ(swept.count(), 0U);
      }
    }
  }
}

}  // namespace
}  // namespace iog::intake
