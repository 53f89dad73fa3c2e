#include "net/peer_resolver.hpp"

#include <gtest/gtest.h>

namespace iog::net {
namespace {

constexpr std::uint64_t kSecondUs = 1'000'000;
constexpr MacAddress kOld{{0x02, 0, 0, 0, 0, 1}};
constexpr MacAddress kNew{{0x02, 0, 0, 0, 0, 2}};

TEST(PeerResolver, AsksAtOnceAndThenOnceASecondWhileUnknown) {
  PeerResolver resolver;
  int asked = 0;
  for (std::uint64_t now_us = 0; now_us < 10 * kSecondUs; now_us += 1000) {
    asked += resolver.request_due(now_us) ? 1 : 0;
  }
  EXPECT_EQ(asked, 10);
  EXPECT_FALSE(resolver.known());
}

TEST(PeerResolver, AsksAtOnceWhateverTheClockStartsAt) {
  PeerResolver resolver;
  EXPECT_TRUE(resolver.request_due(UINT64_MAX - 5));
  EXPECT_FALSE(resolver.request_due(UINT64_MAX - 4));
}

TEST(PeerResolver, IsSilentFor30SecondsAfterAnAnswer) {
  PeerResolver resolver;
  EXPECT_TRUE(resolver.request_due(0));
  resolver.learn(kOld, 500);
  EXPECT_TRUE(resolver.known());
  EXPECT_EQ(resolver.mac(), kOld);
  EXPECT_FALSE(resolver.request_due(2 * kSecondUs));
  EXPECT_FALSE(resolver.request_due(30 * kSecondUs + 499));
  EXPECT_TRUE(resolver.request_due(30 * kSecondUs + 500));
}

TEST(PeerResolver, KeepsTheOldAddressUntilANewOneComes) {
  PeerResolver resolver;
  resolver.learn(kOld, 0);
  int asked = 0;
  for (std::uint64_t now_us = 0; now_us < 40 * kSecondUs; now_us += 1000) {
    asked += resolver.request_due(now_us) ? 1 : 0;
    ASSERT_EQ(resolver.mac(), kOld);
  }
  EXPECT_EQ(asked, 10);
  resolver.learn(kNew, 40 * kSecondUs);
  EXPECT_EQ(resolver.mac(), kNew);
  EXPECT_FALSE(resolver.request_due(41 * kSecondUs));
}

// Nobody has asked for it: the known station is asked, alone, and its answer is all that counts.
TEST(PeerResolver, AnotherStationIsNotBelievedWhileTheKnownOneAnswers) {
  PeerResolver resolver;
  ASSERT_TRUE(resolver.request_due(0));
  resolver.learn(kOld, 0);
  for (std::uint64_t now_us = 2 * kSecondUs; now_us < 20 * kSecondUs; now_us += kSecondUs) {
    resolver.learn(kNew, now_us);
    ASSERT_EQ(resolver.mac(), kOld);
    ASSERT_EQ(resolver.request_due(now_us), kOld);
    resolver.learn(kNew, now_us + 10);
    resolver.learn(kOld, now_us + 20);
    ASSERT_EQ(resolver.told()->at_us, now_us + 20);
    ASSERT_FALSE(resolver.request_due(now_us + kSecondUs - 1)) << "an answer ends the doubt";
  }
}

TEST(PeerResolver, AnotherStationIsBelievedWhenTheKnownOneIsSilent) {
  PeerResolver resolver;
  resolver.learn(kOld, 0);
  resolver.learn(kNew, 10);
  ASSERT_EQ(resolver.request_due(20), kOld);
  EXPECT_FALSE(resolver.request_due(kSecondUs));
  EXPECT_EQ(resolver.request_due(20 + kSecondUs), kBroadcastMac);
  resolver.learn(kNew, 30 + kSecondUs);
  EXPECT_EQ(resolver.mac(), kNew);
  EXPECT_FALSE(resolver.request_due(5 * kSecondUs));
}

// As it is asked every 30 s: who is faster than the known one has not asked for the question.
TEST(PeerResolver, TheRegularQuestionLetsNoOtherStationIn) {
  PeerResolver resolver;
  resolver.learn(kOld, 0);
  ASSERT_EQ(resolver.request_due(kArpRefreshUs), kBroadcastMac);
  resolver.learn(kNew, kArpRefreshUs + 1);
  EXPECT_EQ(resolver.mac(), kOld);
}

TEST(PeerResolver, HearingFromThePeerPostponesTheQuestion) {
  PeerResolver resolver;
  for (std::uint64_t now_us = 0; now_us < 300 * kSecondUs; now_us += 20 * kSecondUs) {
    resolver.learn(kOld, now_us);
    EXPECT_FALSE(resolver.request_due(now_us + 19 * kSecondUs));
  }
}

}  // namespace
}  // namespace iog::net
