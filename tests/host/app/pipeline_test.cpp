// The whole walk, from datagrams to messages, on a fake platform.
#include "app/pipeline.hpp"

#include <array>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/fake_platform.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "stream/grid_hash.hpp"

namespace iog::app {
namespace {

using intake::PacketDrop;
using intake::SensorState;
using tests::FakePlatform;
using tests::LuxMessage;
using tests::ThreeLux;

constexpr std::uint32_t kReplayer = 0x0A000202;

struct Datagram {
  std::uint16_t port = 0;
  std::vector<std::byte> bytes;
  std::uint32_t source = kReplayer;
};

struct Bench {
  FakePlatform platform;
  std::unique_ptr<Pipeline<FakePlatform>> pipeline =
      std::make_unique<Pipeline<FakePlatform>>(ThreeLux::kVehicle, kReplayer, platform);

  void take(const Datagram& datagram, std::uint64_t now_us) {
    pipeline->take({datagram.source, datagram.port, datagram.bytes}, now_us);
  }
};

// One scan in `parts` messages: their sectors cover 100 degrees, each with some points.
std::vector<Datagram> scan(std::uint16_t port, int number, int parts, tests::Random& random) {
  std::vector<Datagram> datagrams;
  for (int part = 0; part < parts; ++part) {
    const int left = 1600 - 3200 * part / parts;
    const int right = 1600 - 3200 * (part + 1) / parts;
    LuxMessage message{
        .scan_number = number, .start_ticks = left, .end_ticks = right, .points = {}};
    for (int i = 0; i < 40; ++i) {
      message.points.push_back({.layer = random.between(0, 3),
                                .echo = random.one_in(10) ? 1 : 0,
                                .flags = random.one_in(20) ? 4 : 0,
                                .angle_ticks = random.between(right, left),
                                .range_cm = random.between(0, 5200)});
    }
    datagrams.push_back({port, message.bytes()});
  }
  return datagrams;
}

std::vector<Datagram> frame_of_three(int number, int parts, tests::Random& random) {
  std::vector<Datagram> frame;
  for (const int port : {100, 101, 102}) {
    std::ranges::move(scan(static_cast<std::uint16_t>(port), number, parts, random),
                      std::back_inserter(frame));
  }
  return frame;
}

TEST(Pipeline, AFrameClosesWhenEverySensorHasDelivered) {
  tests::Random random(71);
  Bench bench;
  bench.platform.link_drops = 4;
  const auto frame = frame_of_three(9, 2, random);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    EXPECT_TRUE(bench.platform.frames.empty());
    bench.take(frame[i], 1000 + i);
  }
  ASSERT_EQ(bench.platform.frames.size(), 1U);
  const auto& received = bench.platform.frames[0];
  EXPECT_EQ(received.header.complete_sensors, 0b111);
  EXPECT_EQ(received.header.partial_sensors, 0);
  EXPECT_EQ(received.header.flags, 0);
  EXPECT_EQ(received.header.packets_fused, 6U);
  EXPECT_EQ(received.header.packets_dropped, 4U);
  EXPECT_EQ(received.header.points_used + received.header.points_other, 240U);
  EXPECT_EQ(received.end.opened_us, 1000U);
  EXPECT_EQ(received.header.closed_us, 1005U);
  EXPECT_EQ(received.end.stack_used_bytes, 4711U);
  EXPECT_EQ(received.end.stopwatch_hz, 1000U);
  EXPECT_EQ(received.end.temperature_dc, 612);
  EXPECT_EQ(received.end.link_counter_count, 2);
  EXPECT_EQ(received.end.link_counters[1], 12U);
  EXPECT_EQ(received.end.sensors[2].scan_number, 9U);
  EXPECT_EQ(bench.platform.unreadable(), 0);
}

// What arrives is what was fused, and its CRC is that of the grid.
TEST(Pipeline, TheTilesCarryTheGrid) {
  tests::Random random(72);
  Bench bench;
  auto direct = std::make_unique<fusion::FrameFusion>(ThreeLux::kVehicle);
  for (const Datagram& datagram : frame_of_three(1, 1, random)) {
    lidar::IbeoLux lux;
    ASSERT_EQ(lux.decode(datagram.bytes), lidar::DecodeStatus::kOk);
    lux.for_each_point([&](const lidar::ScanPoint& point) {
      direct->add(ThreeLux::kVehicle.sensors[datagram.port - 100U], point);
    });
    bench.take(datagram, 1);
  }
  direct->finish();
  ASSERT_EQ(bench.platform.frames.size(), 1U);
  const auto& received = bench.platform.frames[0];
  EXPECT_TRUE(received.cells == tests::cells_of(*direct));
  stream::GridHash hash;
  std::uint32_t tiles = 0;
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    std::array<grid::OccupancyIndex, tile_coding::kTileBytes> cells;
    if (direct->view().copy_tile(tile, cells)) {
      hash.add(tile, std::as_bytes(std::span(cells)));
      ++tiles;
    }
  }
  EXPECT_EQ(received.end.grid_crc, hash.value());
  EXPECT_EQ(received.end.tiles_sent, tiles);
}

// docs/model.md section 3: every permutation of sensors and packets of a frame gives the same grid.
TEST(Pipeline, EveryPermutationOfSensorsAndPacketsGivesTheSameGrid) {
  tests::Random random(73);
  auto frame = frame_of_three(4, 2, random);
  std::vector<std::size_t> order{0, 1, 2, 3, 4, 5};
  std::uint32_t crc = 0;
  int permutation = 0;
  do {
    if (permutation % tests::effort(1, 48) == 0) {
      Bench bench;
      for (const std::size_t i : order) {
        bench.take(frame[i], 5);
      }
      ASSERT_EQ(bench.platform.frames.size(), 1U);
      crc = permutation == 0 ? bench.platform.frames[0].end.grid_crc : crc;
      ASSERT_EQ(bench.platform.frames[0].end.grid_crc, crc);
    }
    ++permutation;
  } while (std::ranges::next_permutation(order).found);
  EXPECT_EQ(permutation, 720);
}

TEST(Pipeline, AFrameIsOverAfterItsPeriodAndSaysWhoIsMissing) {
  tests::Random random(74);
  Bench bench;
  bench.take(scan(100, 1, 1, random)[0], 10'000);
  bench.take(scan(101, 1, 2, random)[0], 20'000);
  bench.pipeline->tick(49'999);
  EXPECT_TRUE(bench.platform.frames.empty());
  bench.pipeline->tick(50'000);
  ASSERT_EQ(bench.platform.frames.size(), 1U);
  const auto& received = bench.platform.frames[0];
  EXPECT_EQ(received.header.flags, stream::kFlagTimedOut);
  EXPECT_EQ(received.header.complete_sensors, 0b001);
  EXPECT_EQ(received.header.partial_sensors, 0b010);
  EXPECT_EQ(received.end.sensors[0].state, SensorState::kComplete);
  EXPECT_EQ(received.end.sensors[1].state, SensorState::kPartial);
  EXPECT_EQ(received.end.sensors[2].state, SensorState::kNeverSeen);
}

TEST(Pipeline, ASensorsNextScanClosesTheFrameBeforeIt) {
  tests::Random random(75);
  Bench bench;
  bench.take(scan(100, 1, 1, random)[0], 1000);
  bench.take(scan(100, 2, 1, random)[0], 2000);
  ASSERT_EQ(bench.platform.frames.size(), 1U);
  EXPECT_EQ(bench.platform.frames[0].header.packets_fused, 1U);
  bench.pipeline->tick(42'000);
  ASSERT_EQ(bench.platform.frames.size(), 2U);
  EXPECT_EQ(bench.platform.frames[1].end.sensors[0].scan_number, 2U);
  EXPECT_EQ(bench.platform.frames[1].header.frame_number, 1U);
}

// Silence is reported, and is not evidence: an empty grid has no tiles.
TEST(Pipeline, SilenceIsReportedEveryTwoPeriods) {
  tests::Random random(76);
  Bench bench;
  for (const Datagram& datagram : frame_of_three(1, 1, random)) {
    bench.take(datagram, 1000);
  }
  for (std::uint64_t now = 1000; now <= 241'000; now += 1000) {
    bench.pipeline->tick(now);
  }
  ASSERT_EQ(bench.platform.frames.size(), 4U);
  const auto& silent = bench.platform.frames[2];
  EXPECT_EQ(silent.end.tiles_sent, 0U);
  EXPECT_EQ(silent.end.grid_crc, 0U);
  EXPECT_FALSE(silent.header.has_evidence());
  EXPECT_EQ(silent.end.sensors[0].state, SensorState::kSilent);
  EXPECT_EQ(silent.end.sensors[0].age_frames, 2);
}

std::uint32_t drops(const Bench& bench, PacketDrop cause) {
  return bench.platform.frames.back().end.packet_drops[static_cast<std::size_t>(cause)];
}

TEST(Pipeline, EveryBadDatagramIsCountedByItsCauseAndCostsNothingElse) {
  tests::Random random(77);
  Bench clean;
  Bench hostile;
  const auto frame = frame_of_three(1, 2, random);
  auto too_short = frame[0];
  too_short.bytes.pop_back();
  auto wrong_type = frame[0];
  wrong_type.bytes[0] = std::byte{0};
  auto wrong_point = frame[0];
  wrong_point.bytes[68] = std::byte{0x0F};  // layer 15
  auto wrong_angle = frame[0];
  wrong_angle.bytes[24 + 23] = std::byte{0};  // ticks per turn
  const std::vector<Datagram> bad{
      too_short,
      wrong_type,
      wrong_point,
      wrong_angle,
      {999, frame[0].bytes},              // a port that no sensor sends to
      {100, frame[0].bytes, 0x0A0000AA},  // from an address that is no sensor's
      {100, {}}};
  for (const Datagram& datagram : frame) {
    for (const Datagram& garbage : bad) {
      hostile.take(garbage, 10);
    }
    clean.take(datagram, 10);
    hostile.take(datagram, 10);
    if (&datagram != &frame.back()) {
      hostile.take(datagram, 10);  // a duplicate
    }
  }
  ASSERT_EQ(hostile.platform.frames.size(), 1U);
  EXPECT_EQ(hostile.platform.frames[0].cells, clean.platform.frames[0].cells);
  EXPECT_EQ(drops(hostile, PacketDrop::kWrongLength), 12U);
  EXPECT_EQ(drops(hostile, PacketDrop::kWrongType), 6U);
  EXPECT_EQ(drops(hostile, PacketDrop::kWrongPoint), 6U);
  EXPECT_EQ(drops(hostile, PacketDrop::kWrongAngle), 6U);
  EXPECT_EQ(drops(hostile, PacketDrop::kStranger), 12U);
  EXPECT_EQ(drops(hostile, PacketDrop::kDuplicate), 5U);
  EXPECT_EQ(hostile.platform.frames[0].header.packets_dropped, 12U + 6 + 6 + 6 + 12 + 5);
}

TEST(Pipeline, ASensorMaySendFromItsOwnAddress) {
  tests::Random random(78);
  Bench bench;
  auto datagram = scan(100, 1, 1, random)[0];
  datagram.source = ThreeLux::kConfigs[0].source_ipv4;
  bench.take(datagram, 0);
  bench.pipeline->tick(40'000);
  ASSERT_EQ(bench.platform.frames.size(), 1U);
  EXPECT_EQ(bench.platform.frames[0].header.packets_fused, 1U);
}

TEST(Pipeline, APartOfAClosedScanIsLate) {
  tests::Random random(79);
  Bench bench;
  const auto parts = scan(100, 1, 2, random);
  bench.take(parts[0], 0);
  bench.pipeline->tick(40'000);
  bench.take(parts[1], 41'000);
  bench.pipeline->tick(200'000);
  EXPECT_EQ(drops(bench, PacketDrop::kLate), 1U);
}

// A sensor that sends more points than its description allows cannot overrun the frame.
TEST(Pipeline, AFloodOfPointsIsRefused) {
  Bench bench;
  for (int i = 0; i < 40; ++i) {
    LuxMessage message{.start_ticks = 10, .end_ticks = 0, .points = {}};
    message.points.assign(100, {.angle_ticks = 5, .range_cm = 1000 + i});
    bench.take({100, message.bytes()}, 0);
  }
  bench.pipeline->tick(40'000);
  ASSERT_EQ(bench.platform.frames.size(), 1U);
  EXPECT_EQ(bench.platform.frames[0].end.sensors[0].points, 2400U);
  EXPECT_EQ(drops(bench, PacketDrop::kOverBudget), 16U);
  EXPECT_EQ(bench.platform.frames[0].end.fates[static_cast<std::size_t>(vehicle::Fate::kMalformed)],
            1600U);
}

// When the network takes no more, tiles are lost and counted; the grid's CRC still names all of it.
TEST(Pipeline, LostTilesAreCountedAndLeaveNoTrace) {
  tests::Random random(80);
  const auto frame = frame_of_three(1, 1, random);
  Bench whole;
  Bench stuck;
  stuck.platform.allow_messages(3);
  for (const Datagram& datagram : frame) {
    whole.take(datagram, 0);
    stuck.take(datagram, 0);
  }
  EXPECT_TRUE(stuck.platform.frames.empty());
  EXPECT_EQ(stuck.platform.tile_messages(), 3);
  ASSERT_GT(whole.platform.tile_messages(), 3);
  stuck.platform.allow_messages(5000);
  for (const Datagram& datagram : frame_of_three(2, 1, random)) {
    stuck.take(datagram, 50'000);
    whole.take(datagram, 50'000);
  }
  ASSERT_EQ(stuck.platform.frames.size(), 1U);
  EXPECT_EQ(stuck.platform.frames[0].end.grid_crc, whole.platform.frames[1].end.grid_crc);
  EXPECT_EQ(stuck.platform.frames[0].end.tiles_sent, whole.platform.frames[1].end.tiles_sent);
}

// A number is given to what could not be sent, too: so a receiver misses it.
TEST(Pipeline, EveryMessageIsNumberedAndOfThisRun) {
  tests::Random random(81);
  Bench bench;
  bench.platform.allow_messages(3);
  for (const Datagram& datagram : frame_of_three(1, 1, random)) {
    bench.take(datagram, 0);
  }
  bench.platform.allow_messages(5000);
  for (const Datagram& datagram : frame_of_three(2, 1, random)) {
    bench.take(datagram, 50'000);
  }
  const auto& sequences = bench.platform.sequences();
  ASSERT_GT(sequences.size(), 4U);
  EXPECT_EQ(bench.platform.frames.back().header.run_number, tests::FakePlatform::kRunNumber);
  EXPECT_EQ(sequences[2], 2U);
  EXPECT_GT(sequences[3], 3U);
  for (std::size_t i = 4; i < sequences.size(); ++i) {
    ASSERT_EQ(sequences[i], sequences[i - 1] + 1);
  }
}

// Keeps what it is given of a frame.
class TileList {
 public:
  void begin_frame(const stream::Header& header) {
    numbers.push_back(header.frame_number);
    tiles = 0;
  }
  void take_tile(std::size_t tile, tile_coding::TileCells cells) {
    hash.add(tile, cells);
    ++tiles;
  }
  void end_frame() { ++ended; }

  std::vector<std::uint32_t> numbers;
  std::uint32_t tiles = 0;
  int ended = 0;
  stream::GridHash hash;
};

// The network is one sink among others: all see the same frame.
TEST(Pipeline, EverySinkIsGivenEveryFrame) {
  tests::Random random(83);
  FakePlatform platform;
  std::array<TileList, 2> sinks;
  const auto pipeline = std::make_unique<Pipeline<FakePlatform, TileList, TileList>>(
      ThreeLux::kVehicle, kReplayer, platform, sinks[0], sinks[1]);
  for (const Datagram& datagram : frame_of_three(1, 1, random)) {
    pipeline->take({datagram.source, datagram.port, datagram.bytes}, 40'000);
  }
  ASSERT_EQ(platform.frames.size(), 1U);
  for (const TileList& sink : sinks) {
    EXPECT_EQ(sink.numbers, std::vector<std::uint32_t>{0});
    EXPECT_EQ(sink.ended, 1);
    EXPECT_EQ(sink.tiles, platform.frames[0].end.tiles_sent);
    EXPECT_EQ(sink.hash.value(), platform.frames[0].end.grid_crc);
  }
}

// Both codings carry the same cells. The shared cache keeps its content only for the short one.
TEST(Pipeline, TheCodingChangesNothingButTheBytes) {
  tests::Random random(82);
  Bench shortest;
  FakePlatform platform;
  const auto raw = std::make_unique<Pipeline<FakePlatform>>(ThreeLux::kVehicle, kReplayer, platform,
                                                            Coding::kRaw);
  for (int number = 1; number <= 10; ++number) {
    const auto now_us = static_cast<std::uint64_t>(number) * 40'000;
    for (const Datagram& datagram : frame_of_three(number, 1, random)) {
      shortest.take(datagram, now_us);
      raw->take({datagram.source, datagram.port, datagram.bytes}, now_us);
    }
  }
  ASSERT_EQ(platform.frames.size(), 10U);
  ASSERT_EQ(shortest.platform.frames.size(), 10U);
  for (std::size_t i = 0; i < platform.frames.size(); ++i) {
    EXPECT_EQ(shortest.platform.frames[i].cells, platform.frames[i].cells);
    EXPECT_EQ(shortest.platform.frames[i].end.grid_crc, platform.frames[i].end.grid_crc);
  }
  EXPECT_LT(2 * shortest.platform.tile_messages(), platform.tile_messages());
  EXPECT_EQ(shortest.platform.kept_messages, std::ssize(shortest.platform.sequences()));
  EXPECT_EQ(platform.kept_messages, 0);
  EXPECT_FALSE(shortest.platform.is_cache_kept);
  EXPECT_EQ(shortest.platform.unreadable() + platform.unreadable(), 0);
}

}  // namespace
}  // namespace iog::app
