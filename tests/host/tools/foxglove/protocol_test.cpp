// By the specification of the protocol: names of the fields, and the bytes of a message's head.
#include "tools/foxglove/protocol.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "gtest/gtest.h"

namespace iog::tools::foxglove {
namespace {

using Json = nlohmann::json;

TEST(FoxgloveProtocol, TheServerHasNoOptionalCapability) {
  EXPECT_EQ(Json::parse(server_info("iog view", "17")), Json({{"op", "serverInfo"},
                                                              {"name", "iog view"},
                                                              {"capabilities", Json::array()},
                                                              {"sessionId", "17"}}));
}

TEST(FoxgloveProtocol, ChannelsSayHowTheirMessagesAreRead) {
  const std::vector<Channel> channels{{.id = 3, .topic = "/tf", .type = &ros::kTfMessage},
                                      {.id = 9, .topic = "/grid", .type = &ros::kOccupancyGrid}};
  const Json said = Json::parse(advertise(channels));
  EXPECT_EQ(said["op"], "advertise");
  ASSERT_EQ(said["channels"].size(), 2U);
  EXPECT_EQ(said["channels"][0], Json({{"id", 3},
                                       {"topic", "/tf"},
                                       {"encoding", "cdr"},
                                       {"schemaName", "tf2_msgs/msg/TFMessage"},
                                       {"schema", ros::kTfMessage.definition},
                                       {"schemaEncoding", "ros2msg"}}));
  EXPECT_EQ(Json::parse(advertise({})), Json({{"op", "advertise"}, {"channels", Json::array()}}));
  EXPECT_EQ(Json::parse(unadvertise(channels)),
            Json({{"op", "unadvertise"}, {"channelIds", {3, 9}}}));
}

TEST(FoxgloveProtocol, AStatusIsTextWhateverIsInIt) {
  EXPECT_EQ(Json::parse(status(Level::kWarning, "no \"such\" thing")),
            Json({{"op", "status"}, {"level", 1}, {"message", "no \"such\" thing"}}));
  EXPECT_EQ(Json::parse(status(Level::kError, "\xFF", "it")),
            Json({{"op", "status"}, {"level", 2}, {"message", "\uFFFD"}, {"id", "it"}}));
}

// Operation 1, then two numbers in little endian, 4 and 8 bytes.
TEST(FoxgloveProtocol, AMessageBeginsWithSubscriptionAndTime) {
  constexpr std::array<unsigned, 13> kBytes{1,    4,    3,    2,    1,    0x18, 0x17,
                                            0x16, 0x15, 0x14, 0x13, 0x12, 0x11};
  const MessageHead head = message_head(0x01020304, 0x1112131415161718);
  EXPECT_TRUE(std::ranges::equal(head, kBytes, {},
                                 [](std::byte byte) { return std::to_integer<unsigned>(byte); }));
}

}  // namespace
}  // namespace iog::tools::foxglove
