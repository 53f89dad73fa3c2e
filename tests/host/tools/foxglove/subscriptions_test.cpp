// A client may have one subscription for each channel, by a number of its own; what it cannot have
// it is told. What every wrong request is told tests/e2e/foxglove asks.
#include "tools/foxglove/subscriptions.hpp"

#include "gtest/gtest.h"

namespace iog::tools::foxglove {
namespace {

const std::vector<Channel> kChannels{{.id = 1, .topic = "/tf", .type = &ros::kTfMessage},
                                     {.id = 4, .topic = "/grid", .type = &ros::kOccupancyGrid}};

class SubscriptionsTest : public testing::Test {
 protected:
  // How many answers there are.
  std::size_t ask(std::string_view text) {
    return subscriptions_.take_text(text, kChannels).size();
  }

  Subscriptions subscriptions_;
};

TEST_F(SubscriptionsTest, WhatIsInOrderHasNoAnswer) {
  EXPECT_TRUE(subscriptions_.is_empty());
  EXPECT_EQ(
      ask(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":4},{"id":7,"channelId":1}]})"),
      0U);
  EXPECT_EQ(subscriptions_.of_channel(1), 7U);
  EXPECT_EQ(subscriptions_.of_channel(4), 0U);
  EXPECT_EQ(ask(R"({"op":"unsubscribe","subscriptionIds":[0]})"), 0U);
  EXPECT_EQ(subscriptions_.of_channel(4), std::nullopt);
  EXPECT_EQ(ask(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":4}]})"), 0U) << "again";
  subscriptions_.forget(1);
  subscriptions_.forget(4);
  EXPECT_TRUE(subscriptions_.is_empty());
}

// The good one among bad ones is taken.
TEST_F(SubscriptionsTest, WhatCannotBeIsRefusedAndNothingElse) {
  EXPECT_EQ(ask(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2},{"id":1,"channelId":4},
                 {"id":1,"channelId":1},{"id":2,"channelId":4},{"id":"3","channelId":1}]})"),
            4U);
  EXPECT_EQ(subscriptions_.of_channel(4), 1U);
  EXPECT_EQ(subscriptions_.of_channel(1), std::nullopt);
  EXPECT_EQ(ask(R"({"op":"unsubscribe","subscriptionIds":[2,1,1]})"), 2U);
  EXPECT_TRUE(subscriptions_.is_empty());
}

TEST_F(SubscriptionsTest, AnswersAreFewHoweverMuchIsWrong) {
  std::string request = R"({"op":"unsubscribe","subscriptionIds":[0)";
  for (int id = 1; id < 1000; ++id) {
    request += "," + std::to_string(id);
  }
  const Subscriptions::Answers answers = subscriptions_.take_text(request + "]}", kChannels);
  ASSERT_EQ(answers.size(), Subscriptions::kMostAnswers);
  EXPECT_NE(answers.back().find("993 more"), std::string::npos) << answers.back();
}

// Numbers are of 32 bits, as in a message's head.
TEST_F(SubscriptionsTest, TheLargestIdIsOne) {
  EXPECT_EQ(ask(R"({"op":"subscribe","subscriptions":[{"id":4294967295,"channelId":4}]})"), 0U);
  EXPECT_EQ(subscriptions_.of_channel(4), 4'294'967'295U);
  EXPECT_EQ(ask(R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})"), 1U);
  EXPECT_EQ(ask(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967300}]})"), 1U);
}

}  // namespace
}  // namespace iog::tools::foxglove
