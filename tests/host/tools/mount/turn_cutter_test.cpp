#include "tools/mount/turn_cutter.hpp"

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

constexpr std::int32_t kTurn = 36'000;

// A packet of a unit that has turned so far, clockwise.
lidar::PacketInfo at(std::int32_t turned) {
  return {.sector = {.first_ticks = static_cast<std::uint16_t>((kTurn - turned % kTurn) % kTurn),
                     .width_ticks = 480}};
}

// Of the packets of so many turns, of which `lost` are left out.
template <typename Lost>
int turns_of(std::int32_t turns, const Lost& lost) {
  TurnCutter cutter(kTurn);
  int ends = 0;
  for (std::int32_t turned = 0; turned < turns * kTurn; turned += 480) {
    if (!lost(turned / 480)) {
      ends += cutter.ends_before(at(turned)) ? 1 : 0;
    }
  }
  return ends + (cutter.is_nearly_whole() ? 1 : 0);
}

TEST(TurnCutter, CountsTurns) {
  EXPECT_EQ(turns_of(10, [](int) { return false; }), 10);
  EXPECT_EQ(turns_of(1, [](int) { return false; }), 1);
}

TEST(TurnCutter, CountsThemThroughLosses) {
  EXPECT_EQ(turns_of(10, [](int packet) { return packet % 3 == 1; }), 10);
  EXPECT_EQ(turns_of(10, [](int packet) { return packet % 75 > 20 && packet % 75 < 60; }), 10);
}

TEST(TurnCutter, APacketThatWasOvertakenEndsNothing) {
  TurnCutter cutter(kTurn);
  int ends = 0;
  for (std::int32_t turned = 0; turned < 10 * kTurn; turned += 960) {
    ends += cutter.ends_before(at(turned + 480)) ? 1 : 0;
    ends += cutter.ends_before(at(turned)) ? 1 : 0;
  }
  EXPECT_EQ(ends, 9);
}

TEST(TurnCutter, HalfATurnIsNone) {
  TurnCutter cutter(kTurn);
  EXPECT_FALSE(cutter.is_nearly_whole());
  for (std::int32_t turned = 0; turned < kTurn / 2; turned += 480) {
    EXPECT_FALSE(cutter.ends_before(at(turned)));
  }
  EXPECT_FALSE(cutter.is_nearly_whole());
}

// Datagram `number` of `datagrams` has its share of a scan's sector, counter-clockwise.
TEST(TurnCutter, AScanOfPointsIsATurnWhicheverWayItGoes) {
  constexpr std::uint32_t kDatagrams = 8;
  constexpr std::uint32_t kShare = kTurn / kDatagrams;
  for (const bool goes_left : {true, false}) {
    TurnCutter cutter(kTurn, true);
    int ends = 0;
    for (std::uint32_t i = 0; i < 10 * kDatagrams; ++i) {
      const std::uint32_t number = goes_left ? i % kDatagrams : kDatagrams - 1 - i % kDatagrams;
      const auto scan = 65'530 + i / kDatagrams;
      ends +=
          cutter.ends_before({.scan_number = scan,
                              .sector = {.first_ticks = static_cast<std::uint16_t>(number * kShare),
                                         .width_ticks = kShare}})
              ? 1
              : 0;
    }
    EXPECT_EQ(ends, 9);
    EXPECT_TRUE(cutter.is_nearly_whole());
  }
}

}  // namespace
}  // namespace iog::tools
