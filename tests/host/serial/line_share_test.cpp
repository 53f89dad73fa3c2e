// The laws of a fair line: all of it is used, in proportion, and silence is neither saved nor lost.
#include "serial/line_share.hpp"

#include <array>
#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::serial {
namespace {

constexpr std::array<std::uint32_t, 3> kWeights{1, 3, 8};
constexpr std::size_t kMessage = 1400;  // bytes at most

TEST(LineShare, IsInProportionToTheWeightsWhateverTheMessagesAre) {
  LineShare<3> share{kWeights};
  tests::Random random(1);
  std::array<std::size_t, 3> bytes{};
  std::size_t sum = 0;
  while (sum < 1'000'000) {
    const std::size_t party = *share.next({true, true, true});
    const std::size_t message = 1 + random.below(party == 0 ? 200 : kMessage);
    share.charge(party, message);
    bytes[party] += message;
    sum += message;
  }
  for (std::size_t party = 0; party < 3; ++party) {
    // Never farther from its part than the longest messages of all reach.
    EXPECT_NEAR(static_cast<double>(bytes[party]), static_cast<double>(sum) * kWeights[party] / 12,
                3 * kMessage);
  }
}

TEST(LineShare, GivesTheWholeLineToOneThatIsAlone) {
  LineShare<3> share{kWeights};
  for (int messages = 0; messages < 1000; ++messages) {
    ASSERT_EQ(share.next({false, true, false}), 1u);
    share.charge(1, kMessage);
  }
}

TEST(LineShare, BeginsWithTheFirst) {
  LineShare<3> share{kWeights};
  EXPECT_EQ(share.next({true, true, true}), 0u);
  EXPECT_EQ(LineShare<3>{kWeights}.next({false, true, true}), 1u);
}

TEST(LineShare, WhoWasSilentHasSavedNothing) {
  LineShare<3> share{kWeights};
  for (int messages = 0; messages < 1000; ++messages) {
    share.charge(*share.next({false, true, true}), kMessage);
  }
  std::size_t bytes = 0;
  for (int messages = 0; messages < 24; ++messages) {
    const std::size_t party = *share.next({true, true, true});
    share.charge(party, kMessage);
    bytes += party == 0 ? kMessage : 0;
  }
  EXPECT_LE(bytes, (24 / 12 + 2) * kMessage);
}

TEST(LineShare, NobodyIsNext) {
  LineShare<3> share{kWeights};
  EXPECT_FALSE(share.next({false, false, false}).has_value());
}

}  // namespace
}  // namespace iog::serial
