#include "lab/experiments/peer_ratios.hpp"

#include <vector>

#include "gtest/gtest.h"

namespace iog::lab {
namespace {

// What lab/peers/page asks of the three libraries: 3, 400 and 1,000 times.
TEST(PeerRatios, AreThoseOfTheGoals) {
  const std::vector<PeerRatio> ratios = peer_ratios();
  ASSERT_EQ(ratios.size(), 3U);
  EXPECT_EQ(ratios[0].goal, 3);
  EXPECT_EQ(ratios[1].goal, 400);
  EXPECT_EQ(ratios[2].goal, 1000);
  for (const PeerRatio& ratio : ratios) {
    EXPECT_FALSE(ratio.peer.empty());
    EXPECT_GT(ratio.city, 0) << ratio.peer;
    EXPECT_GT(ratio.ring_road, 0) << ratio.peer;
  }
}

}  // namespace
}  // namespace iog::lab
