// Frames of dense lidars that several cores fuse while they come: the same messages as of one core,
// byte for byte.
#include <gtest/gtest.h>
#include <memory>
#include <tuple>
#include <vector>

#include "app/pipeline.hpp"
#include "fakes/ground_car.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "sharing_platform.hpp"
#include "vlp16_turns.hpp"

namespace iog::app {
namespace {

using testing::Accident;
using testing::kAnyTimeUs;
using testing::kReplayer;
using testing::kShortlyUs;
using testing::SharingPlatform;
using testing::TimedDatagram;
using testing::turns_of_vlp16;
using tests::LevelVlp16;
using tests::MixedCar;
using Message = SharingPlatform::Message;

constexpr std::uint64_t kTurnUs = 200'000;

// The last message of each frame, and its header.
struct Report {
  stream::Header header;
  stream::FrameEnd end;
};
std::vector<Report> reports_in(const std::vector<Message>& messages) {
  std::vector<Report> reports;
  for (const Message& message : messages) {
    if (!stream::ends_frame(message)) {
      continue;
    }
    Report& report = reports.emplace_back();
    std::span<const std::byte> body;
    EXPECT_EQ(stream::read_header(std::span(message).subspan(protection::kProtectionBytes),
                                  report.header, body),
              stream::ReadStatus::kOk);
    EXPECT_EQ(stream::read_frame_end(body, report.header.sensor_count, report.end),
              stream::ReadStatus::kOk);
  }
  return reports;
}

// One unit, three turns: six parts each for four cores, and what is left.
std::vector<TimedDatagram> three_turns() { return turns_of_vlp16(100, 3, false, 25'000); }

// Two units with two returns: in a frame they have more points than parts that are full have
// places.
std::vector<TimedDatagram> more_parts_than_places() {
  std::vector<TimedDatagram> drive = turns_of_vlp16(100, 2, true, 4'000);
  std::ranges::move(turns_of_vlp16(101, 2, true, 4'000), std::back_inserter(drive));
  std::ranges::stable_sort(drive, {}, &TimedDatagram::now_us);
  return drive;
}

struct Played {
  std::vector<Message> messages;
  std::vector<Report> reports;
  std::uint32_t helped = 0;
  std::size_t rounds = 0;
  work::Loss fate = work::Loss::kNone;
};

struct Mishap {
  Accident accident = Accident::kNone;
  std::size_t round = 0;
  std::uint32_t delay_us = 0;
};

Played play(vehicle::Vehicle car, const std::vector<TimedDatagram>& drive, std::size_t cores,
            const Mishap& mishap = {}) {
  car.frame_period_us = kTurnUs + kTurnUs / 2;
  SharingPlatform platform(cores, mishap.accident == Accident::kNone ? kAnyTimeUs : kShortlyUs);
  const auto pipeline = std::make_unique<Pipeline<SharingPlatform>>(car, kReplayer, platform);
  platform.let_happen(mishap.accident, mishap.round);
  platform.delay(mishap.delay_us);
  pipeline->start(drive.front().now_us);
  for (const TimedDatagram& datagram : drive) {
    pipeline->take({kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
  }
  pipeline->tick(pipeline->deadline_us());
  return {platform.messages, reports_in(platform.messages), platform.items_of_helpers(),
          platform.rounds, platform.fate_of_victim()};
}

// By one core that nothing happens to: what the others are compared with.
const Played& three_turns_alone() {
  static const Played alone = play(LevelVlp16::kVehicle, three_turns(), 1);
  return alone;
}

// The same unit follows the ground: its second and third turn are judged by what was seen before.
const vehicle::Vehicle& ground_vlp16() {
  static const tests::GroundCar car(LevelVlp16::kVehicle, {220, 2'200}, {600, 300});
  return car.vehicle();
}
const Played& ground_alone() {
  static const Played alone = play(ground_vlp16(), three_turns(), 1);
  return alone;
}

class FuseDenseBy : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FuseDenseBy, CoresGivesTheMessagesOfOne) {
  const Played& alone = three_turns_alone();
  const Played together = play(LevelVlp16::kVehicle, three_turns(), GetParam());
  ASSERT_GE(alone.reports.size(), 3U);
  EXPECT_EQ(alone.reports[1].header.packets_fused, 150U);
  EXPECT_GT(alone.messages.size(), 30U);
  EXPECT_TRUE(together.messages == alone.messages);
  EXPECT_GT(together.helped, 0U);
}

TEST_P(FuseDenseBy, CoresOverTheGroundGivesTheMessagesOfOne) {
  const Played& alone = ground_alone();
  const auto count = [&](std::size_t frame, vehicle::Fate fate) {
    return alone.reports[frame].end.fates[static_cast<std::size_t>(fate)];
  };
  for (const vehicle::Fate fate :
       {vehicle::Fate::kGround, vehicle::Fate::kOverhang, vehicle::Fate::kUnderGround}) {
    EXPECT_GT(count(1, fate), 0U);
    EXPECT_EQ(three_turns_alone().reports[1].end.fates[static_cast<std::size_t>(fate)], 0U);
  }
  EXPECT_EQ(count(1, vehicle::Fate::kOutsideHeightBand), 0U);
  const Played together = play(ground_vlp16(), three_turns(), GetParam());
  EXPECT_TRUE(together.messages == alone.messages);
  EXPECT_GT(together.helped, 0U);
}

// Each packet comes in the place of another one of its turn.
TEST_P(FuseDenseBy, CoresOverTheGroundDoesNotMindTheOrderOfPackets) {
  constexpr std::size_t kPacketsOfTurn = 150;
  std::vector<TimedDatagram> drive = three_turns();
  tests::Random random(7);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const std::size_t turn = i / kPacketsOfTurn * kPacketsOfTurn;
    const auto other = turn + random.below(static_cast<std::uint32_t>(kPacketsOfTurn));
    std::swap(drive[i].bytes, drive[other].bytes);
  }
  EXPECT_TRUE(play(ground_vlp16(), drive, GetParam()).messages == ground_alone().messages);
  EXPECT_TRUE(play(ground_vlp16(), drive, 1).messages == ground_alone().messages);
}

// 57,600 points of a turn, 6,144 a part: rounds of a part for each core while they come, one of
// what is left, one that joins; and those of encoding.
TEST_P(FuseDenseBy, CoresDoesMostOfItBeforeTheFrameEnds) {
  std::vector<TimedDatagram> turn = three_turns();
  turn.resize(149);
  SharingPlatform platform(GetParam(), kAnyTimeUs);
  vehicle::Vehicle car = LevelVlp16::kVehicle;
  car.frame_period_us = kTurnUs + kTurnUs / 2;
  const auto pipeline = std::make_unique<Pipeline<SharingPlatform>>(car, kReplayer, platform);
  pipeline->start(turn.front().now_us);
  for (const TimedDatagram& datagram : turn) {
    pipeline->take({kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
  }
  EXPECT_EQ(platform.rounds, 149ULL * 384 / (GetParam() * 6'144));
}

// Parts that find no place are joined while the frame is open. The units' own limits are those of a
// turn at 10 Hz, and are raised.
TEST_P(FuseDenseBy, CoresOfAFullFrameGivesTheMessagesOfOne) {
  constexpr std::uint32_t kPointsOfTurn = 120'000;
  vehicle::Vehicle car = MixedCar::kVehicle;
  std::vector<vehicle::Sensor> sensors(car.sensors.begin(), car.sensors.end());
  for (vehicle::Sensor& sensor : sensors) {
    if (lidar::turns(sensor.format)) {
      sensor.max_points_per_scan = kPointsOfTurn;
    }
  }
  car.sensors = sensors;
  const std::vector<TimedDatagram> drive = more_parts_than_places();
  static const Played alone = play(car, drive, 1);
  const Played together = play(car, drive, GetParam());
  EXPECT_GT(alone.reports.front().header.packets_fused * 384, fusion::kPartPlaces * 6'144);
  EXPECT_EQ(alone.reports.back().header.packets_dropped, 0U);
  EXPECT_TRUE(together.messages == alone.messages);
  EXPECT_GT(together.helped, 0U);
}

INSTANTIATE_TEST_SUITE_P(TwoToFour, FuseDenseBy, ::testing::Values(2U, 3U, 4U));

TEST(FuseDense, DelaysDoNotShow) {
  const Mishap delays{.delay_us = 300};
  EXPECT_TRUE(play(LevelVlp16::kVehicle, three_turns(), 4, delays).messages ==
              three_turns_alone().messages);
}

// Evidence of both signs that is added one after the other does not join of parts: core 0 alone.
TEST(FuseDense, ByAnotherRuleIsForCore0) {
  vehicle::Vehicle car = LevelVlp16::kVehicle;
  car.rule = vehicle::FusionRule::kBayes;
  EXPECT_FALSE(is_fused_together(car));
  EXPECT_TRUE(play(car, three_turns(), 3).messages == play(car, three_turns(), 1).messages);
}

TEST(FuseDense, IsForDenseLidars) {
  EXPECT_TRUE(is_fused_together(LevelVlp16::kVehicle));
  EXPECT_TRUE(is_fused_together(MixedCar::kVehicle));
  EXPECT_FALSE(is_fused_together(tests::ThreeLux::kVehicle));
}

// Of three cores' first turn, rounds 0 to 2 fuse parts as they come, 3 what is left, 4 joins.
class FuseDenseDespite : public ::testing::TestWithParam<std::tuple<Accident, std::size_t>> {};

TEST_P(FuseDenseDespite, TheLossOfACoreGivesTheMessagesOfOne) {
  const auto [accident, round] = GetParam();
  const Played hurt =
      play(LevelVlp16::kVehicle, three_turns(), 3, {.accident = accident, .round = round});
  EXPECT_TRUE(hurt.messages == three_turns_alone().messages);
  EXPECT_NE(hurt.fate, work::Loss::kNone);
}

TEST_P(FuseDenseDespite, TheLossOfACoreOverTheGroundGivesTheMessagesOfOne) {
  const auto [accident, round] = GetParam();
  const Played hurt =
      play(ground_vlp16(), three_turns(), 3, {.accident = accident, .round = round});
  EXPECT_TRUE(hurt.messages == ground_alone().messages);
  EXPECT_NE(hurt.fate, work::Loss::kNone);
}

INSTANTIATE_TEST_SUITE_P(
    Phases, FuseDenseDespite,
    ::testing::Combine(::testing::Values(Accident::kFaultBefore, Accident::kFaultAfter,
                                         Accident::kHangBefore, Accident::kHangAfter),
                       ::testing::Values(0U, 1U, 3U, 4U)));

}  // namespace
}  // namespace iog::app
