// The laws of the shaper: never more than a burst, never faster than the rate, nothing lost by
// waiting.
#include "board/common/ethernet/transmit_shaper.hpp"

#include <gtest/gtest.h>

namespace iog::imx6 {
namespace {

using S = board::TransmitShaper;

// Sends as much as allowed at each of `passes` moments that are step_us apart.
std::uint64_t sent_in(std::uint32_t step_us, std::uint32_t passes) {
  S shaper;
  std::uint64_t sent = 0;
  for (std::uint64_t pass = 0; pass < passes; ++pass) {
    const std::size_t now = shaper.allowed(pass * step_us);
    EXPECT_LE(now, S::kBurstFrames);
    shaper.spend(now);
    sent += now;
  }
  return sent;
}

TEST(TransmitShaper, BeginsWithOneBurst) {
  S shaper;
  EXPECT_EQ(shaper.allowed(0), S::kBurstFrames);
  shaper.spend(S::kBurstFrames);
  EXPECT_EQ(shaper.allowed(S::kWindowUs - 1), 0u);
  EXPECT_EQ(shaper.allowed(S::kWindowUs), S::kFramesPerWindow);
}

TEST(TransmitShaper, KeepsTheRateHoweverOftenItIsAsked) {
  for (const std::uint32_t step_us : {1u, 7u, 100u, 249u, 250u, 251u, 600u, 999u, 1000u}) {
    const std::uint32_t passes = 1'000'000 / step_us;
    const std::uint64_t sent = sent_in(step_us, passes);
    const std::uint64_t windows = std::uint64_t{passes - 1} * step_us / S::kWindowUs;
    EXPECT_LE(sent, S::kBurstFrames + windows * S::kFramesPerWindow) << step_us;
    EXPECT_GE(sent, windows * S::kFramesPerWindow) << step_us;
  }
}

TEST(TransmitShaper, ALongSilenceBuysOneBurstNotMore) {
  S shaper;
  shaper.spend(shaper.allowed(0));
  EXPECT_EQ(shaper.allowed(10'000'000'000), S::kBurstFrames);
}

// The numbers of the comment in the header.
TEST(TransmitShaper, ACompleteGridLeavesWithinThe40MsBetweenTwo) {
  S shaper;
  std::uint64_t now_us = 0;
  for (std::size_t left = 1088; left != 0; now_us += 1000) {
    const std::size_t now = std::min(left, shaper.allowed(now_us));
    shaper.spend(now);
    left -= now;
  }
  EXPECT_LE(now_us, 34'000u);
  constexpr std::uint64_t kWireBytes = 1514 + 4 + 8 + 12;
  EXPECT_LT(kWireBytes * 8 * S::kFramesPerWindow * 1'000'000 / S::kWindowUs, 400'000'000u);
}

}  // namespace
}  // namespace iog::imx6
