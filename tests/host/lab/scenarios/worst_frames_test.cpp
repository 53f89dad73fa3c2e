// A worst frame measures what it says only if the target believes all of it: a message refused, a
// point dropped or a scan left incomplete would make it cheap. And its grids must be right where
// the fusion is strained most.
#include "lab/scenarios/worst_frames.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <tuple>

#include "gtest/gtest.h"

#include "lab/evidence/fusion_rules.hpp"
#include "lab/evidence/projection.hpp"
#include "lab/evidence/values.hpp"
#include "lidar/ibeo_lux.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

constexpr std::uint64_t kSeed = 1;

const tools::CatalogueEntry& car() { return tools::find_vehicle("reference_car"); }

// The frames that the target sends of the first ones of this kind.
std::vector<tools::GridFrame> fused(const WorstFrame& worst, std::uint32_t count) {
  std::vector<tools::GridFrame> frames;
  tools::FrameAssembler assembler(
      [&](tools::GridFrame&& frame) { frames.push_back(std::move(frame)); });
  const auto target = std::make_unique<tools::OfflineTarget>(
      *car().vehicle, [&](std::span<const std::byte> message) { assembler.take(message); });
  for (std::uint32_t frame = 0; frame < count; ++frame) {
    for (const tools::CapturedDatagram& datagram : worst_datagrams(worst, kSeed, frame)) {
      static_cast<void>(target->take(datagram));
    }
  }
  target->finish();
  assembler.finish();
  return frames;
}

FramePoints points_of(const WorstFrame& worst) {
  FramePoints points;
  for (const tools::CapturedDatagram& datagram : worst_datagrams(worst, kSeed, 0)) {
    const std::size_t sensor = tools::sensor_of_port(car(), datagram.destination.port);
    lidar::IbeoLux decoder;
    EXPECT_EQ(decoder.decode(datagram.payload), lidar::DecodeStatus::kOk);
    decoder.for_each_point([&](const lidar::ScanPoint& point) {
      points.push_back({sensor, point});
    });
  }
  return points;
}

std::int32_t signed_ticks(const lidar::ScanPoint& point) {
  constexpr std::int32_t kTurn = lidar::IbeoLux::kTicksPerTurn;
  return point.azimuth_ticks > kTurn / 2 ? point.azimuth_ticks - kTurn : point.azimuth_ticks;
}

class Worst : public testing::TestWithParam<WorstFrame> {};

INSTANTIATE_TEST_SUITE_P(Frames, Worst,
                         testing::ValuesIn(all_worst_frames().begin(), all_worst_frames().end()),
                         [](const auto& frame) { return std::string(frame.param.name); });

TEST_P(Worst, EveryPointIsBelievedAndEveryScanComplete) {
  constexpr std::uint32_t kFrames = 3;
  const std::vector<tools::GridFrame> frames = fused(GetParam(), kFrames);
  ASSERT_EQ(frames.size(), kFrames);
  for (const tools::GridFrame& frame : frames) {
    EXPECT_EQ(frame.header.complete_sensors, 0b1111);
    EXPECT_EQ(frame.header.packets_dropped, 0U);
    const auto& fates = frame.end.fates;
    const auto of = [&](vehicle::Fate fate) { return fates[static_cast<std::size_t>(fate)]; };
    const std::uint32_t believed =
        of(vehicle::Fate::kUsed) + of(vehicle::Fate::kTooFar) + of(vehicle::Fate::kLaterEcho);
    EXPECT_GT(believed, 0U);
    EXPECT_EQ(believed, frame.header.points_used + frame.header.points_other);
  }
}

TEST_P(Worst, NoScanIsLongerThanTheDescriptionAllows) {
  std::vector<std::size_t> counts(car().sensors.size());
  for (const SensorPoint& point : points_of(GetParam())) {
    ++counts[point.sensor];
  }
  for (std::size_t sensor = 0; sensor < counts.size(); ++sensor) {
    EXPECT_LE(counts[sensor], car().vehicle->sensors[sensor].max_points_per_scan);
  }
}

// By an account of the evidence that shares neither walk nor order of fusion with the target.
TEST_P(Worst, TheGridIsThatOfTheEvidence) {
  const auto values = indexes(probabilities({}), 0.05, index::Quantisation::kBlurring);
  const FrameEvidence evidence = project(*car().vehicle, points_of(GetParam()));
  const std::vector<std::int32_t> expected =
      fuse_indexes(evidence, values, IndexRule::kHitsWin, 127);
  const std::vector<tools::GridFrame> frames = fused(GetParam(), 1);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_TRUE(std::ranges::equal(frames.front().cells, expected));
}

TEST_P(Worst, SameSeedSameBytes) {
  const auto payloads = [](std::uint32_t frame) {
    std::vector<std::vector<std::byte>> bytes;
    for (const tools::CapturedDatagram& datagram : worst_datagrams(GetParam(), kSeed, frame)) {
      bytes.push_back(datagram.payload);
    }
    return bytes;
  };
  EXPECT_EQ(payloads(0), payloads(0));
}

// Steps of half a degree (16 ticks), and of each beam the echoes 0, 1, 2 without a gap, each once
// and further away than the one before.
void expect_scan_of_a_lux(const WorstFrame& worst) {
  std::set<std::tuple<std::size_t, int, std::int32_t, int>> beams;
  lidar::ScanPoint before;
  for (const auto& [sensor, point] : points_of(worst)) {
    EXPECT_EQ(signed_ticks(point) % 16, 0);
    EXPECT_TRUE(beams.emplace(sensor, point.layer, signed_ticks(point), point.echo).second);
    if (point.echo > 0) {
      EXPECT_EQ(point.echo, before.echo + 1);
      EXPECT_EQ(point.azimuth_ticks, before.azimuth_ticks);
      EXPECT_EQ(point.layer, before.layer);
      EXPECT_GT(point.range_mm, before.range_mm);
    }
    before = point;
  }
}

TEST(WorstFrames, AreWhatALuxCouldSendUnlessForged) {
  for (const WorstFrame& worst : all_worst_frames()) {
    if (!worst.is_forged) {
      SCOPED_TRACE(worst.name);
      expect_scan_of_a_lux(worst);
    }
  }
}

TEST(WorstFrames, FillAScan) {
  constexpr std::size_t kBeams = std::size_t{4} * 4 * 201;  // scanners, layers, directions
  for (const char* const name : {"full_range", "random_ranges", "layers_apart", "beyond_range",
                                 "random_azimuths", "diagonal", "one_direction"}) {
    EXPECT_EQ(points_of(find_worst_frame(name)).size(), kBeams) << name;
  }
  for (const char* const name : {"three_echoes", "short_beams", "flood"}) {
    EXPECT_EQ(points_of(find_worst_frame(name)).size(), 3 * kBeams) << name;
  }
}

TEST(WorstFrames, RandomAzimuthsAreOnNoRaster) {
  std::set<std::int32_t> directions;
  for (const auto& [sensor, point] : points_of(find_worst_frame("random_azimuths"))) {
    EXPECT_NE(signed_ticks(point) % 16, 0);
    directions.insert(signed_ticks(point));
  }
  EXPECT_GT(directions.size(), 1000U);
}

TEST(WorstFrames, ThreeEchoesMarkWithEveryPoint) {
  const FramePoints points = points_of(find_worst_frame("three_echoes"));
  EXPECT_EQ(project(*car().vehicle, points).hits.size(), points.size());
}

// A LUX's line of 49 m along a diagonal crosses 49 / 0.1 * sqrt(2) borders; 3 degrees off, one in
// a thousand fewer.
TEST(WorstFrames, DiagonalsCrossTheMostBorders) {
  for (const auto& [sensor, point] : points_of(find_worst_frame("diagonal"))) {
    const auto& lux = car().vehicle->sensors[sensor];
    const auto line = vehicle::aim(lux, point.layer, point.azimuth_ticks).line;
    EXPECT_GT(line.through({49, 50}).crossed(), 490 * 1.4142 * 0.998 - 2);
  }
}

// 49 m are sixteen tiles; three front scanners and one at the back.
TEST(WorstFrames, OneDirectionMeetsFewTiles) {
  EXPECT_LE(fused(find_worst_frame("one_direction"), 1).front().tiles, 4U * 17U);
}

TEST(WorstFrames, AnUnknownNameIsSaid) {
  EXPECT_THROW(static_cast<void>(find_worst_frame("rush_hour")), tools::UsageError);
}

}  // namespace
}  // namespace iog::lab
