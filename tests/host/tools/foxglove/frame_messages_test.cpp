// What clients can have of a stream, frame by frame: the newest one, and nothing that waits.
#include "tools/foxglove/frame_messages.hpp"

#include <algorithm>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "net/udp.hpp"

namespace iog::tools::foxglove {
namespace {

class FrameMessagesTest : public testing::Test {
 protected:
  void take_frame(std::uint32_t vehicle_id, std::size_t datagrams = 2) {
    for (std::size_t i = 0; i < datagrams; ++i) {
      feed_.take_datagram({.time_us = 5, .source = {}, .destination = {}, .payload = {}});
    }
    GridFrame frame;
    frame.header.vehicle_id = vehicle_id;
    const SeenPoint point{.x_cm = 150, .y_cm = -200, .z_cm = 25, .fate = vehicle::Fate::kTooFar};
    feed_.take_frame({.frame = &frame,
                      .live = &live_,
                      .classes = &classes_,
                      .time_us = 1000,
                      .points = {&point, 1}});
  }

  static std::vector<std::string_view> topics_of(std::span<const Channel> channels) {
    std::vector<std::string_view> topics;
    std::ranges::transform(channels, std::back_inserter(topics), &Channel::topic);
    return topics;
  }

  LiveFeed feed_;
  LiveGrid live_;
  LiveClasses classes_;
  FrameMessages messages_;
};

TEST_F(FrameMessagesTest, WhileNobodyListensNothingIsKept) {
  take_frame(1);
  EXPECT_EQ(feed_.newest(), nullptr);
  feed_.listen(true);
  EXPECT_EQ(feed_.newest(), nullptr);
  take_frame(1);
  ASSERT_NE(feed_.newest(), nullptr);
  EXPECT_EQ(feed_.newest()->number, 2U) << "all frames are counted";
  EXPECT_EQ(feed_.newest()->datagrams.size(), 2U) << "those of the frame before are gone";
  feed_.listen(false);
  EXPECT_EQ(feed_.newest(), nullptr);
}

TEST_F(FrameMessagesTest, TheNewestFrameTakesThePlaceOfTheOneBefore) {
  int news = 0;
  feed_.on_news([&] { ++news; });
  feed_.listen(true);
  for (int i = 0; i < 3; ++i) {
    take_frame(1);
  }
  EXPECT_EQ(news, 3);
  EXPECT_EQ(feed_.newest()->number, 3U);
}

TEST_F(FrameMessagesTest, DatagramsOfNoFrameDoNotPileUp) {
  feed_.listen(true);
  take_frame(1, LiveFeed::kMostDatagrams + 1);
  EXPECT_EQ(feed_.newest()->datagrams.size(), 1U);
  feed_.take_datagram({.time_us = 5,
                       .source = {},
                       .destination = {},
                       .payload = std::vector<std::byte>(net::kMaxUdpPayloadBytes + 1)});
  take_frame(1, 0);
  EXPECT_TRUE(feed_.newest()->datagrams.empty()) << "too long for a message of any target";
}

// A frame of indexes without classes.
TEST_F(FrameMessagesTest, ChannelsAreOfWhatTheStreamHasAndOfOneVehicle) {
  feed_.listen(true);
  take_frame(1);
  const FrameMessages::Changes first = messages_.take(feed_.newest());
  EXPECT_TRUE(first.gone.empty());
  EXPECT_EQ(topics_of(messages_.channels()),
            (std::vector<std::string_view>{"/grid", "/iogrid/image", "/iogrid/grid", "/points",
                                           "/diagnostics", "/iogrid/messages"}));
  EXPECT_EQ(first.added.size(), 6U);
  take_frame(1);
  const FrameMessages::Changes second = messages_.take(feed_.newest());
  EXPECT_TRUE(second.gone.empty() && second.added.empty());
  take_frame(2);
  const FrameMessages::Changes third = messages_.take(feed_.newest());
  EXPECT_EQ(third.gone.size(), 6U);
  EXPECT_EQ(third.added.size(), 6U);
  EXPECT_GT(third.added.front().id, 6U) << "no id has two meanings";
}

TEST_F(FrameMessagesTest, AMessageIsMadeOnceForAll) {
  feed_.listen(true);
  take_frame(1);
  static_cast<void>(messages_.take(feed_.newest()));
  std::set<std::uint32_t> all;
  for (const Channel& channel : messages_.channels()) {
    all.insert(channel.id);
  }
  const std::uint32_t points = messages_.channels()[3].id;
  const auto some = messages_.of_channels({points});
  ASSERT_EQ(some.size(), 1U);
  EXPECT_EQ(some.front().arrival_ns, 1'000'000U);
  const auto everything = messages_.of_channels(all);
  ASSERT_EQ(everything.size(), 7U) << "and two datagrams";
  EXPECT_EQ(everything[3].bytes, some.front().bytes) << "the same bytes, not equal ones";
  EXPECT_TRUE(messages_.of_channels({999}).empty());
}

// By hand from the definition: a point of 1.5, -2 and 0.25 m, 16 bytes behind a head of 12 + 12
// (base_link and its zero, aligned) + 8 + 4 and its fields.
TEST_F(FrameMessagesTest, APointIsInMetres) {
  feed_.listen(true);
  take_frame(1);
  static_cast<void>(messages_.take(feed_.newest()));
  const auto message = messages_.of_channels({messages_.channels()[3].id}).front();
  constexpr std::array<unsigned, 16> kPoint{0, 0, 0xC0, 0x3F, 0, 0, 0, 0xC0,
                                            0, 0, 0x80, 0x3E, 3, 0, 0, 0};
  const std::span end = std::span(*message.bytes).last(17);  // and is_dense
  EXPECT_TRUE(std::ranges::equal(end.first(16), kPoint, {},
                                 [](std::byte byte) { return std::to_integer<unsigned>(byte); }));
  EXPECT_EQ(end.back(), std::byte{1});
}

}  // namespace
}  // namespace iog::tools::foxglove
