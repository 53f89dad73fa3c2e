// A drive perceived by several cores: the same messages as by one, byte for byte, wherever one of
// them is lost.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "app/pipeline.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "perception_drive.hpp"
#include "sharing_platform.hpp"

namespace iog::app {
namespace {

using testing::Accident;
using testing::kAnyTimeUs;
using testing::kPeriodUs;
using testing::kShortlyUs;
using testing::kStartUs;
using testing::SharingPlatform;
using testing::TimedDatagram;

// All that the window holds after a frame, as far as it means something.
class Masses {
 public:
  void begin_frame(const stream::Header& /*header*/) {}
  void take_tile(std::size_t /*tile*/, tile_coding::TileCells /*cells*/) {}
  void end_frame() {}
  void take_classes(const stream::ClassEnd& end, const window::WindowView& classes) {
    most_slices = std::max<std::size_t>(most_slices, end.slice_count);
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (classes.is_known(slot)) {
        keep(classes.tile(slot));
      }
    }
  }

  std::vector<std::byte> bytes;
  std::size_t most_slices = 0;

 private:
  template <typename T>
  void keep_bytes(const T& value) {
    const auto all = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), all.begin(), all.end());
  }
  void keep(const window::Tile& tile) {
    for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
      if (tile.is_known(group)) {
        keep_bytes(tile.free[group]);
        keep_bytes(tile.taken[group]);
      }
    }
    keep_bytes(tile.aged_at);
    keep_bytes(tile.evidence_at);
    keep_bytes(tile.is_free_alone);
    keep_bytes(tile.found);
    keep_bytes(tile.ground);
  }
};

using Pipeline = PerceptionPipeline<SharingPlatform, Masses>;

struct Outcome {
  std::vector<SharingPlatform::Message> messages;
  std::vector<std::byte> masses;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

// A car that turns while it drives, among things that come and go: a scan a frame, which lasts two
// slices. In the last frame but one a period of the ground begins.
constexpr int kFirst = 10;
constexpr int kFrames = 5;

pose::Message on_circle(std::uint64_t time_us) {
  constexpr double kYawRate = 0.5;  // rad/s
  constexpr double kRadiusMm = 1000 * testing::kSpeedMps / kYawRate;
  const double angle = kYawRate * static_cast<double>(time_us) / 1e6;
  pose::Message message = testing::pose_at(time_us);
  message.pose = {
      .x_mm = static_cast<std::int32_t>(std::lround(kRadiusMm * std::sin(angle))),
      .y_mm = static_cast<std::int32_t>(std::lround(kRadiusMm * (1 - std::cos(angle)))),
      .heading = static_cast<std::uint32_t>(std::llround(angle / (2 * std::numbers::pi) * 0x1p32))};
  message.yaw_urad_per_s = 500'000;
  return message;
}

// By packets of so many ticks of the scanner's angle.
std::vector<TimedDatagram> drive(int packet_ticks = 800) {
  std::vector<TimedDatagram> datagrams;
  tests::Random random(5);
  for (std::uint64_t time_us = (kFirst - 1) * kPeriodUs; time_us < (kFirst + kFrames) * kPeriodUs;
       time_us += 10'000) {
    datagrams.push_back(testing::datagram_of(on_circle(time_us)));
  }
  for (int frame = kFirst; frame < kFirst + kFrames; ++frame) {
    const std::uint64_t end_us = static_cast<std::uint64_t>(frame) * kPeriodUs - 1'000;
    const std::uint64_t end = kStartUs + end_us;
    int range_cm = 2'000;
    for (int left = 1600; left > -1600; left -= packet_ticks) {
      tests::LuxMessage part{.scan_number = frame,
                             .start_ticks = left,
                             .end_ticks = left - packet_ticks,
                             .points = {},
                             .start_ntp = testing::ntp_of(end - testing::kSweepUs),
                             .end_ntp = testing::ntp_of(end)};
      for (int ticks = left; ticks > left - packet_ticks; ticks -= 16) {
        range_cm = random.one_in(12) ? random.between(400, 4'800) : range_cm;
        part.points.push_back(
            {.layer = 2, .angle_ticks = ticks, .range_cm = range_cm + 8 * random.between(-1, 1)});
      }
      datagrams.push_back({end_us, 100, part.bytes()});
    }
  }
  std::ranges::stable_sort(datagrams, {}, &TimedDatagram::now_us);
  return datagrams;
}

struct Bench {
  explicit Bench(std::size_t cores, std::uint32_t patience_us = kAnyTimeUs,
                 const window::Rules& rules = {},
                 std::uint8_t log2_slice_ms = pose::SourceDescription{}.log2_slice_ms)
      : vehicle(car.vehicle()), platform(cores, patience_us) {
    vehicle.window = rules;
    vehicle.has_objects = true;
    vehicle.poses.log2_slice_ms = log2_slice_ms;
    pipeline = std::make_unique<Pipeline>(vehicle, testing::kReplayer, platform, Coding::kShortest,
                                          masses);
  }

  void take(const TimedDatagram& datagram) {
    pipeline->take({testing::kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
  }
  [[nodiscard]] Outcome outcome() {
    static const std::vector<TimedDatagram> datagrams = drive();
    return outcome_of(datagrams);
  }
  [[nodiscard]] Outcome outcome_of(const std::vector<TimedDatagram>& datagrams) {
    for (const TimedDatagram& datagram : datagrams) {
      take(datagram);
    }
    return {.messages = platform.messages, .masses = masses.bytes};
  }

  testing::Car car{tests::OneLux::kVehicle, true};
  vehicle::Vehicle vehicle;
  SharingPlatform platform;
  Masses masses;
  std::unique_ptr<Pipeline> pipeline;
};

// A little more for each step of an index.
consteval evidence::Assignment make_graded() {
  evidence::Assignment graded;
  for (std::size_t n = 0; n < evidence::kGradedIndexes; ++n) {
    graded.occupied[n] = static_cast<std::uint8_t>(3 * n);
    graded.free[n] = static_cast<std::uint8_t>(n);
  }
  return graded;
}
constexpr evidence::Assignment kGraded = make_graded();

// By the first, cells that are free alone take a way of their own; by the second, how often a cell
// was hit or crossed in a frame shows.
const std::array<window::Rules, 2> kRules{window::Rules{}, window::Rules{.assignment = &kGraded}};

const Outcome& outcome_of_one_core(std::size_t rules = 0) {
  static const std::array outcomes{Bench(1, kAnyTimeUs, kRules[0]).outcome(),
                                   Bench(1, kAnyTimeUs, kRules[1]).outcome()};
  return outcomes[rules];
}

class PerceiveBy : public ::testing::TestWithParam<std::size_t> {};

TEST_P(PerceiveBy, CoresGivesTheMessagesOfOne) {
  Bench bench(GetParam());
  EXPECT_TRUE(bench.outcome() == outcome_of_one_core());
  EXPECT_GT(bench.platform.items_of_helpers(), 0U);
}

// What is left is the same, too.
TEST_P(PerceiveBy, CoresOverBudgetGivesTheMessagesOfOne) {
  constexpr window::Rules kFew{.group_budget = 3'000};
  const Outcome expected = Bench(1, kAnyTimeUs, kFew).outcome();
  EXPECT_FALSE(expected == outcome_of_one_core());
  EXPECT_TRUE(Bench(GetParam(), kAnyTimeUs, kFew).outcome() == expected);
}

TEST_P(PerceiveBy, CoresThatDawdleGivesTheMessagesOfOne) {
  Bench bench(GetParam());
  bench.platform.delay(100);
  EXPECT_TRUE(bench.outcome() == outcome_of_one_core());
}

// A scan of slices of a millisecond: more than are placed at once.
TEST_P(PerceiveBy, CoresThatPlaceManySlicesGiveTheMessagesOfOne) {
  const std::vector<TimedDatagram> datagrams = drive(200);
  const auto outcome_of = [&datagrams](std::size_t cores) {
    Bench bench(cores, kAnyTimeUs, {}, 0);
    Outcome outcome = bench.outcome_of(datagrams);
    EXPECT_GT(bench.masses.most_slices, window::FrameEvidence::kMostAtOnce);
    return outcome;
  };
  EXPECT_TRUE(outcome_of(GetParam()) == outcome_of(1));
}

INSTANTIATE_TEST_SUITE_P(TwoToFour, PerceiveBy, ::testing::Values(2U, 3U, 4U));

// The rounds of the last frame but one, so that there is something to do it wrong to, and a frame
// in which it shows.
struct Rounds {
  std::size_t begin = 0;
  std::size_t end = 0;
};
Rounds rounds_of_a_frame() {
  static const Rounds rounds = [] {
    Bench bench(2);
    Rounds found;
    std::size_t frames = 0;
    std::size_t before = 0;
    for (const TimedDatagram& datagram : drive()) {
      bench.take(datagram);
      if (bench.platform.rounds != before) {
        ++frames;
        found = frames == kFrames - 1 ? Rounds{before, bench.platform.rounds} : found;
        before = bench.platform.rounds;
      }
    }
    return found;
  }();
  return rounds;
}

// Behind which part of a round's items it happens: ahead of the vehicle there is most to do, and
// where that is depends on how a round numbers its items.
constexpr std::array<std::size_t, 3> kPercents{8, 33, 58};
constexpr std::size_t kTries = tests::effort(kPercents.size(), 1);  // of a round

class PerceiveDespite : public ::testing::TestWithParam<Accident> {};

TEST_P(PerceiveDespite, TheLossOfACoreInAnyRoundGivesTheMessagesOfOne) {
  const Rounds rounds = rounds_of_a_frame();
  // Fuse, join; copy, note and place slices; find, update; look at hits; encode both grids; end
  // tiles.
  ASSERT_EQ(rounds.end - rounds.begin, 11U);
  const bool hangs = GetParam() == Accident::kHangAfter;
  int lost = 0;
  for (std::size_t round = rounds.begin; round < rounds.end; round += hangs ? 3 : 1) {
    for (std::size_t i = 0; i < kTries; ++i) {
      const std::size_t rules = (round + i) % 2;
      Bench bench(2, hangs ? kShortlyUs : kAnyTimeUs, kRules[rules]);
      bench.platform.let_happen(GetParam(), round, kPercents[(round + i) % kPercents.size()]);
      ASSERT_TRUE(bench.outcome() == outcome_of_one_core(rules)) << round;
      lost += bench.platform.fate_of_victim() != work::Loss::kNone ? 1 : 0;
    }
  }
  EXPECT_GT(lost, hangs ? tests::effort(3, 0) : tests::effort(15, 4));
}

INSTANTIATE_TEST_SUITE_P(Accidents, PerceiveDespite,
                         ::testing::Values(Accident::kFaultBefore, Accident::kFaultAfter,
                                           Accident::kHangAfter));

// A core is ended by a store in the middle of an item, wherever a page of the pipeline begins.
TEST(PerceiveDespiteAll, ACoreLostInTheMiddleOfAnItemGivesTheMessagesOfOne) {
  const Rounds rounds = rounds_of_a_frame();
  std::uint32_t redone = 0;
  int lost = 0;
  for (std::size_t round = rounds.begin; round < rounds.end; ++round) {
    for (int pages = 0; pages < tests::effort(20, 3); ++pages) {
      const std::size_t rules = static_cast<std::size_t>(pages) % 2;
      Bench bench(2, kAnyTimeUs, kRules[rules]);
      tests::StoreTrap trap(bench.pipeline.get(), sizeof(Pipeline));
      bench.platform.let_happen(Accident::kNone, round, kPercents[round % kPercents.size()]);
      bench.platform.let_trap(trap, pages);
      ASSERT_TRUE(bench.outcome() == outcome_of_one_core(rules)) << round << " " << pages;
      lost += bench.platform.fate_of_victim() == work::Loss::kFaulted ? 1 : 0;
      redone += bench.platform.redone();
    }
  }
  EXPECT_GT(lost, tests::effort(60, 5));
  EXPECT_EQ(redone, static_cast<std::uint32_t>(lost));
}

}  // namespace
}  // namespace iog::app
