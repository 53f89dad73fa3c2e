// How packets are dealt out: each once, a slice after the other, in parts of about the same size.
#include "fusion/frame_parts.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <vector>

#include "fakes/random.hpp"

namespace iog::fusion {
namespace {

KeptPacket packet_of(std::uint8_t group, std::uint16_t bytes) {
  KeptPacket packet{};
  packet.group = group;
  packet.bytes = bytes;
  return packet;
}

// The rounds as (group, packets) of each part.
using Parts = std::vector<std::vector<std::pair<int, std::vector<int>>>>;

Parts rounds_of(const std::vector<KeptPacket>& packets, std::size_t groups) {
  const auto parts = std::make_unique<FrameParts>();
  parts->deal(packets, groups, FrameParts::kMostOfARound);
  Parts rounds;
  for (auto round = parts->next_round(); !round.empty(); round = parts->next_round()) {
    EXPECT_LE(round.size(), FrameParts::kMostOfARound);
    auto& dealt = rounds.emplace_back();
    for (const FramePart& part : round) {
      const auto numbers = parts->packets_of(part);
      dealt.emplace_back(part.group, std::vector<int>(numbers.begin(), numbers.end()));
    }
  }
  return rounds;
}

// 600 bytes in all, 25 a share.
TEST(FrameParts, FullPartsEndAndSlicesEndThem) {
  const std::vector<KeptPacket> packets{packet_of(1, 10), packet_of(0, 30),
                                        packet_of(1, 20), packet_of(0, 5),
                                        packet_of(1, 30), packet_of(FrameSlices::kNowhere, 5),
                                        packet_of(0, 500)};
  EXPECT_EQ(rounds_of(packets, 2),
            (Parts{{{0, {1}}, {0, {3, 6}}, {1, {0, 2}}, {1, {4}}, {255, {5}}}}));
  EXPECT_TRUE(rounds_of({}, 0).empty());
}

TEST(FrameParts, EveryPacketIsInOnePart) {
  tests::Random random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t groups = 1 + random.below(kMaxSlices);
    std::vector<KeptPacket> packets;
    for (std::size_t i = random.below(kMaxFramePackets + 1); i > 0; --i) {
      const std::size_t group = random.below(groups + 1);
      packets.push_back(
          packet_of(group == groups ? FrameSlices::kNowhere : static_cast<std::uint8_t>(group),
                    static_cast<std::uint16_t>(random.one_in(9) ? 65'000 : random.below(1500))));
    }
    std::set<int> seen;
    std::set<int> groups_before;
    for (const auto& round : rounds_of(packets, groups)) {
      std::set<int> groups_here;
      for (const auto& [group, numbers] : round) {
        groups_here.insert(group);
        for (const int number : numbers) {
          EXPECT_EQ(packets[static_cast<std::size_t>(number)].group, group);
          EXPECT_TRUE(seen.insert(number).second);
        }
      }
      for (const int group : groups_here) {
        EXPECT_TRUE(groups_before.insert(group).second) << "a slice in two rounds";
      }
    }
    EXPECT_EQ(seen.size(), packets.size());
  }
}

TEST(FrameParts, OneSliceIsDealtEvenly) {
  const auto parts = std::make_unique<FrameParts>();
  tests::Random random(6);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<KeptPacket> packets;
    std::size_t bytes = 0;
    for (std::size_t i = random.below(200); i > 0; --i) {
      packets.push_back(packet_of(0, static_cast<std::uint16_t>(1 + random.below(1500))));
      bytes += packets.back().bytes;
    }
    const std::size_t most = 1 + random.below(FrameParts::kMostOfARound);
    parts->deal(packets, 1, most);
    const auto round = parts->next_round();
    EXPECT_LE(round.size(), most);
    std::size_t next = 0;
    for (const FramePart& part : round) {
      std::size_t part_bytes = 0;
      for (const std::uint16_t number : parts->packets_of(part)) {
        EXPECT_EQ(number, next++);
        part_bytes += packets[number].bytes;
      }
      EXPECT_LE(part_bytes, bytes / most + 1 + 1500);
    }
    EXPECT_EQ(next, packets.size());
    EXPECT_TRUE(parts->next_round().empty());
  }
}

}  // namespace
}  // namespace iog::fusion
