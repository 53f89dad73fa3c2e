// Messages against those of scapy, and what no message is.
#include "discovery/message.hpp"

#include <gtest/gtest.h>

#include "discovery/bytes.hpp"

namespace iog::discovery::testing {
namespace {

using net::testing::put_be16;

TEST(DiscoveryMessage, ReadsWhatScapyMakes) {
  const Frame bytes = scapy_subscribe();
  const auto message = read_message(bytes);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->session_id, 2);
  EXPECT_EQ(message->flags, kFlagReboot | kFlagUnicast);
  ASSERT_EQ(message->entry_count(), 1U);
  const Entry entry = message->entry(0);
  EXPECT_EQ(entry.type, EntryType::kSubscribe);
  EXPECT_EQ(entry.service, 0x4F47);
  EXPECT_EQ(entry.instance, 1);
  EXPECT_EQ(entry.major, 5);
  EXPECT_EQ(entry.ttl_s, 3U);
  EXPECT_EQ(entry.minor, 0x0005'0001U) << "counter and event group";
  EXPECT_EQ(entry.event_group(), 1);
  EXPECT_EQ(message->udp_endpoint_of(entry), (Endpoint{kSubscriber, 30'500}));
}

TEST(DiscoveryMessage, IsWrittenAsScapyDoes) {
  const Entry offer{.type = EntryType::kOffer,
                    .options = {{{.first = 0, .count = 1}, {}}},
                    .service = 0x4F47,
                    .instance = 1,
                    .major = 5,
                    .ttl_s = 3};
  Frame bytes(message_bytes(1), std::byte{0xEE});
  bytes.resize(write_message(1, kFlagReboot | kFlagUnicast, std::span(&offer, 1),
                             {kConfig.address, kConfig.source_port}, bytes));
  EXPECT_EQ(bytes, scapy_offer());
  const Entry acknowledgement{.type = EntryType::kSubscribeAck,
                              .service = 0x4F47,
                              .instance = 1,
                              .major = 5,
                              .ttl_s = 3,
                              .minor = 0x0005'0001};
  bytes.assign(message_bytes(1), std::byte{0xEE});
  bytes.resize(
      write_message(1, kFlagReboot | kFlagUnicast, std::span(&acknowledgement, 1), {}, bytes));
  EXPECT_EQ(bytes, scapy_acknowledgement());
}

// Whatever is cut off, the lengths tell.
TEST(DiscoveryMessage, ThatIsCutIsNone) {
  const Frame whole = scapy_subscribe();
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    EXPECT_FALSE(read_message(std::span(whole).first(bytes))) << bytes;
    Frame shorter(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(bytes));
    if (bytes >= 8) {
      put_be16(shorter, 6, bytes - 8);  // SOME/IP says so, the arrays do not
      EXPECT_FALSE(read_message(shorter)) << bytes;
    }
  }
}

Frame with_u16(Frame bytes, std::size_t at, std::size_t value) {
  put_be16(bytes, at, value);
  return bytes;
}

TEST(DiscoveryMessage, WithLengthsThatContradictIsNone) {
  const Frame good = scapy_subscribe();
  EXPECT_FALSE(read_message(with_u16(good, 0, 0x4F47))) << "of another service";
  EXPECT_FALSE(read_message(with_u16(good, kSessionAt, 0))) << "sessions count from 1";
  EXPECT_FALSE(read_message(with_u16(good, kEntriesAt + 2, 15))) << "no whole entry";
  EXPECT_FALSE(read_message(with_u16(good, kEntriesAt, 0xFFFF))) << "longer than the datagram";
  EXPECT_FALSE(read_message(with_u16(good, kOptionAt - 2, 11))) << "an option is cut";
  EXPECT_FALSE(read_message(with_u16(good, kOptionAt, 8))) << "a byte behind the last option";
  EXPECT_FALSE(read_message(with_u16(good, kOptionAt, 10))) << "an option beyond the options";
  EXPECT_FALSE(read_message(with_u16(good, kOptionAt, 0))) << "an option without its reserved byte";
  Frame longer = good;
  longer.push_back({});
  put_be16(longer, 6, longer.size() - 8);
  EXPECT_FALSE(read_message(longer)) << "a byte behind the options";
}

std::optional<Endpoint> endpoint_of(const Frame& bytes) {
  const auto message = read_message(bytes);
  return message ? message->udp_endpoint_of(message->entry(0)) : std::nullopt;
}

TEST(DiscoveryMessage, HasOneEndpointOfUdpOrNone) {
  const Frame good = scapy_subscribe();
  Frame tcp = good;
  tcp[kOptionAt + 9] = std::byte{6};
  EXPECT_FALSE(endpoint_of(tcp));
  Frame ipv6 = good;
  ipv6[kOptionAt + 2] = std::byte{0x06};
  EXPECT_FALSE(endpoint_of(ipv6));
  Frame group = good;
  group[kOptionAt + 2] = std::byte{0x14};
  EXPECT_FALSE(endpoint_of(group)) << "a multicast option is no endpoint";
  Frame second_run = good;
  second_run[kEntryAt + 3] = std::byte{0x01};
  EXPECT_TRUE(endpoint_of(second_run));
  Frame none = good;
  none[kEntryAt + 3] = std::byte{0};
  EXPECT_FALSE(endpoint_of(none)) << "an option to which nobody refers";
  Frame beyond = good;
  beyond[kEntryAt + 3] = std::byte{0x20};
  EXPECT_FALSE(endpoint_of(beyond)) << "refers to a second option, which is not there";
  beyond[kEntryAt + 1] = std::byte{0xFF};
  beyond[kEntryAt + 3] = std::byte{0xF0};
  EXPECT_FALSE(endpoint_of(beyond));
}

TEST(DiscoveryMessage, TwoEndpointsAreNone) {
  Frame two = scapy_subscribe();
  const Frame option(two.begin() + kOptionAt, two.end());
  two.insert(two.end(), option.begin(), option.end());
  put_be16(two, 6, two.size() - 8);
  put_be16(two, kOptionAt - 2, 24);
  two[kEntryAt + 3] = std::byte{0x20};
  EXPECT_TRUE(endpoint_of(two)) << "twice the same";
  two.back() = std::byte{0x25};
  EXPECT_FALSE(endpoint_of(two)) << "another port";
  two[kEntryAt + 3] = std::byte{0x10};
  EXPECT_TRUE(endpoint_of(two)) << "of which the entry refers to one";
}

}  // namespace
}  // namespace iog::discovery::testing
