// Frames with classes that several cores fuse: the same messages as of one core, byte for byte.
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "fakes/ground_car.hpp"
#include "perception_bench.hpp"
#include "sharing_platform.hpp"
#include "vlp16_turns.hpp"

namespace iog::app {
namespace {

using testing::Accident;
using testing::Car;
using testing::ClassList;
using testing::kAnyTimeUs;
using testing::kPeriodUs;
using testing::kReplayer;
using testing::kShortlyUs;
using Message = testing::SharingPlatform::Message;
using testing::SharingPlatform;
using testing::TimedDatagram;

constexpr int kFrames = 5;

// Three LUX that sweep one after the other towards walls, so that their points share slices, lines
// and cells. There are no poses before the second frame, so that packets without a place are
// fused, too.
std::vector<TimedDatagram> drive_of_three(int parts) {
  std::vector<TimedDatagram> drive = testing::poses(kPeriodUs, kFrames * kPeriodUs);
  for (int frame = 1; frame <= kFrames; ++frame) {
    for (const int sensor : {0, 1, 2}) {
      const std::uint64_t end_us = static_cast<std::uint64_t>(frame) * kPeriodUs -
                                   3'000 * static_cast<std::uint64_t>(sensor);
      std::ranges::move(testing::scan_of_wall(static_cast<std::uint16_t>(100 + sensor), frame,
                                              parts, end_us, 25 + 4 * sensor),
                        std::back_inserter(drive));
    }
  }
  std::ranges::stable_sort(drive, {}, &TimedDatagram::now_us);
  return drive;
}

struct Bench {
  Bench(const vehicle::Vehicle& vehicle, std::size_t cores, std::uint32_t patience_us)
      : platform(cores, patience_us),
        pipeline(std::make_unique<PerceptionPipeline<SharingPlatform, ClassList>>(
            vehicle, kReplayer, platform, classes)) {}

  void take(const std::vector<TimedDatagram>& drive) {
    for (const TimedDatagram& datagram : drive) {
      while (pipeline->deadline_us() <= datagram.now_us) {
        pipeline->tick(pipeline->deadline_us());
      }
      pipeline->take({kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
    }
    pipeline->tick(pipeline->deadline_us());
  }

  ClassList classes;
  SharingPlatform platform;
  std::unique_ptr<PerceptionPipeline<SharingPlatform, ClassList>> pipeline;
};

// log2_slice_ms: slices of 1 ms are more than a round has room for.
vehicle::Vehicle with_slices(vehicle::Vehicle vehicle, std::uint8_t log2_slice_ms) {
  vehicle.poses.log2_slice_ms = log2_slice_ms;
  return vehicle;
}

struct Played {
  std::vector<Message> messages;
  std::vector<testing::ClassName> names;
  std::uint32_t helped = 0;
  work::Loss fate = work::Loss::kNone;
  std::size_t slices = 0;
};

Played play(std::size_t cores, int parts, std::uint8_t log2_slice_ms,
            Accident accident = Accident::kNone, std::size_t round = 0,
            std::uint32_t delay_us = 0) {
  const Car car(with_slices(tests::ThreeLux::kVehicle, log2_slice_ms), true);
  const auto bench = std::make_unique<Bench>(car.vehicle(), cores,
                                             accident == Accident::kNone ? kAnyTimeUs : kShortlyUs);
  bench->platform.let_happen(accident, round);
  bench->platform.delay(delay_us);
  bench->take(drive_of_three(parts));
  return {bench->platform.messages, bench->classes.names, bench->platform.items_of_helpers(),
          bench->platform.fate_of_victim(), bench->classes.reports.back().end.slice_count};
}

// By one core that nothing happens to: what the others are compared with.
const Played& played_alone(int parts, std::uint8_t log2_slice_ms) {
  static std::map<std::pair<int, std::uint8_t>, Played> all;
  const std::pair key{parts, log2_slice_ms};
  if (!all.contains(key)) {
    all.emplace(key, play(1, parts, log2_slice_ms));
  }
  return all.at(key);
}

class FuseBy : public ::testing::TestWithParam<std::tuple<std::size_t, int, int>> {};

TEST_P(FuseBy, CoresGivesTheMessagesOfOne) {
  const auto [cores, parts, log2_slice_ms] = GetParam();
  const auto slice = static_cast<std::uint8_t>(log2_slice_ms);
  const Played& alone = played_alone(parts, slice);
  const Played together = play(cores, parts, slice);
  ASSERT_GE(alone.names.size(), 4U);
  EXPECT_GT(alone.names.back().tiles, 10U);
  EXPECT_TRUE(together.messages == alone.messages);
  EXPECT_EQ(together.names, alone.names);
  EXPECT_GT(together.helped, 0U);
}

INSTANTIATE_TEST_SUITE_P(TwoToFour, FuseBy,
                         ::testing::Combine(::testing::Values(2U, 3U, 4U),
                                            ::testing::Values(1, 4, 20), ::testing::Values(3)));
// More slices than parts of a round.
INSTANTIATE_TEST_SUITE_P(ShortSlices, FuseBy, ::testing::Values(std::tuple(std::size_t{4}, 20, 0)));

TEST(FuseBy, DelaysDoNotShow) {
  EXPECT_TRUE(play(4, 4, 3, Accident::kNone, 0, 300).messages == played_alone(4, 3).messages);
}

// Round 0 of the first frame with packets fuses, round 1 joins; later ones hand tiles to the
// window, place and encode them.
class FuseDespite : public ::testing::TestWithParam<std::tuple<Accident, int>> {};

TEST_P(FuseDespite, TheLossOfACoreGivesTheMessagesOfOne) {
  const auto [accident, round] = GetParam();
  const Played hurt = play(3, 4, 3, accident, static_cast<std::size_t>(round));
  EXPECT_TRUE(hurt.messages == played_alone(4, 3).messages);
  EXPECT_NE(hurt.fate, work::Loss::kNone);
}

INSTANTIATE_TEST_SUITE_P(
    Phases, FuseDespite,
    ::testing::Combine(::testing::Values(Accident::kFaultBefore, Accident::kFaultAfter,
                                         Accident::kHangBefore, Accident::kHangAfter),
                       ::testing::Values(0, 1)));

// Three turns of a VLP-16, in frames of a fifth of a turn; its ground is renewed with every fifth
// or sixth of them.
std::vector<Message> play_turns(const vehicle::Vehicle& like, std::size_t cores) {
  constexpr std::uint64_t kBeginUs = 900'000;  // its packets come from 1 s on
  const Car car(like, false, 5'000);
  const auto bench = std::make_unique<Bench>(car.vehicle(), cores, kAnyTimeUs);
  std::vector<TimedDatagram> drive = testing::turns_of_vlp16(100, 3, false, 25'000);
  std::ranges::move(testing::poses(kBeginUs, 1'700'000), std::back_inserter(drive));
  std::ranges::stable_sort(drive, {}, &TimedDatagram::now_us);
  bench->take(drive);
  EXPECT_EQ(bench->platform.items_of_helpers() > 0, cores > 1);
  return bench->platform.messages;
}

TEST(FuseOverGround, CoresGiveTheMessagesOfOne) {
  const tests::GroundCar car(tests::LevelVlp16::kVehicle, {220, 2'200}, {600, 300});
  const std::vector<Message> alone = play_turns(car.vehicle(), 1);
  EXPECT_GT(alone.size(), 100U);
  EXPECT_FALSE(alone == play_turns(tests::LevelVlp16::kVehicle, 1));
  for (const std::size_t cores : {2U, 3U, 4U}) {
    EXPECT_TRUE(play_turns(car.vehicle(), cores) == alone) << cores;
  }
}

}  // namespace
}  // namespace iog::app
