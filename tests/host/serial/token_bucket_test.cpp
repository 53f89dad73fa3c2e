// The laws of the token bucket: never more than a burst, never faster than the link, and nothing is
// lost by asking often.
#include "serial/token_bucket.hpp"

#include <array>
#include <gtest/gtest.h>

namespace iog::serial {
namespace {

constexpr std::uint32_t kRate = 11'520;  // bytes a second at 115200 baud

TEST(TokenBucket, KeepsTheRateHoweverOftenItIsAsked) {
  for (const std::uint32_t step_us : {1u, 7u, 87u, 999u, 1000u, 7000u, 22'000u}) {
    TokenBucket bucket;
    std::uint64_t sent = 0;
    std::uint64_t now_us = 0;
    for (; now_us < 2'000'000; now_us += step_us) {
      bucket.refill(now_us, kRate);
      ASSERT_LE(bucket.tokens(), TokenBucket::burst_bytes(kRate));
      sent += bucket.tokens();
      bucket.spend(bucket.tokens());
    }
    const std::uint64_t carried = (now_us - step_us) * kRate / 1'000'000;
    EXPECT_LE(sent, carried + TokenBucket::burst_bytes(kRate)) << step_us;
    EXPECT_GE(sent + 1, carried) << step_us;
  }
}

// 40 ms of 115200 baud, ten bits a byte.
TEST(TokenBucket, IsAFramePeriodAheadOfTheLinkAtMost) {
  EXPECT_EQ(TokenBucket::burst_bytes(kRate), 460u);
}

TEST(TokenBucket, ALongSilenceBuysOneBurstNotMore) {
  for (const std::uint32_t rate : std::array<std::uint32_t, 2>{kRate, 92'160}) {
    TokenBucket bucket;
    bucket.refill(1'000'000'000'000, rate);
    EXPECT_EQ(bucket.tokens(), TokenBucket::burst_bytes(rate));
    bucket.spend(bucket.tokens());
    bucket.refill(1'000'000'000'000, rate);
    EXPECT_EQ(bucket.tokens(), 0u);
  }
}

}  // namespace
}  // namespace iog::serial
