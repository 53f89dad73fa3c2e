// The laws of the fair queue: the whole link is used, in proportion to the weights, and a flow
// neither saves nor loses by silence.
#include "serial/fair_queue.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::serial {
namespace {

constexpr std::array<std::uint32_t, 3> kWeights{1, 3, 8};
constexpr std::size_t kMessage = 1400;  // bytes at most

TEST(FairQueue, IsInProportionToTheWeightsWhateverTheMessagesAre) {
  FairQueue<3> queue{kWeights};
  tests::Random random(1);
  std::array<std::size_t, 3> bytes{};
  std::size_t sum = 0;
  while (sum < 1'000'000) {
    const std::size_t flow = *queue.next({true, true, true});
    const std::size_t message = 1 + random.below(flow == 0 ? 200 : kMessage);
    queue.charge(flow, message);
    bytes[flow] += message;
    sum += message;
  }
  for (std::size_t flow = 0; flow < 3; ++flow) {
    // Never farther from its part than the longest messages of all reach.
    EXPECT_NEAR(static_cast<double>(bytes[flow]), static_cast<double>(sum) * kWeights[flow] / 12,
                3 * kMessage);
  }
}

TEST(FairQueue, GivesTheWholeLinkToAFlowThatIsAlone) {
  FairQueue<3> queue{kWeights};
  for (int messages = 0; messages < 1000; ++messages) {
    ASSERT_EQ(queue.next({false, true, false}), 1u);
    queue.charge(1, kMessage);
  }
}

TEST(FairQueue, BeginsWithTheFirst) {
  FairQueue<3> queue{kWeights};
  EXPECT_EQ(queue.next({true, true, true}), 0u);
  EXPECT_EQ(FairQueue<3>{kWeights}.next({false, true, true}), 1u);
}

TEST(FairQueue, AFlowThatWasSilentHasSavedNothing) {
  FairQueue<3> queue{kWeights};
  for (int messages = 0; messages < 1000; ++messages) {
    queue.charge(*queue.next({false, true, true}), kMessage);
  }
  std::size_t bytes = 0;
  for (int messages = 0; messages < 24; ++messages) {
    const std::size_t flow = *queue.next({true, true, true});
    queue.charge(flow, kMessage);
    bytes += flow == 0 ? kMessage : 0;
  }
  EXPECT_LE(bytes, (24 / 12 + 2) * kMessage);
}

TEST(FairQueue, NobodyIsNext) {
  FairQueue<3> queue{kWeights};
  EXPECT_FALSE(queue.next({false, false, false}).has_value());
}

}  // namespace
}  // namespace iog::serial
