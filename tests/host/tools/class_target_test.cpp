// Class grids of simulated drives in which the car moves: by the target's own pipeline, as
// `iog fuse --classes-hashes` makes them.
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gtest/gtest.h"

#include "app/pipeline.hpp"
#include "fakes/fake_platform.hpp"
#include "fakes/random.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/receive/class_record.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/drives/pose_source.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

const CatalogueEntry& four_lux() { return find_vehicle("reference_car"); }

// By frame, its packets in order, and the poses until its last packet.
struct PlacedDrive {
  explicit PlacedDrive(std::uint32_t frames, const PoseOptions& options = {}) {
    const std::uint32_t seconds = frames / 25 + 1;
    Drive drive(four_lux(), 1, seconds, find_scene(kDefaultScene), Motion::kContinuous);
    PoseFeed feed(simulated_poses(drive.scene(), options, 1, seconds + 0.2));
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      packets.push_back(drive.datagrams(frame));
      poses.push_back(feed.take_until(packets.back().back().time_us));
    }
  }

  // These packets of a frame and its poses, by time.
  [[nodiscard]] std::vector<CapturedDatagram> with_poses(
      std::size_t frame, std::vector<CapturedDatagram> datagrams) const {
    datagrams.insert(datagrams.begin(), poses[frame].begin(), poses[frame].end());
    std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
    return datagrams;
  }

  std::vector<std::vector<CapturedDatagram>> packets;
  std::vector<std::vector<CapturedDatagram>> poses;
};

// pause_us: the sender waits so long before each frame.
RunStatistics fused(const vehicle::Vehicle& vehicle, const PlacedDrive& drive,
                    tests::Random* shuffled = nullptr, std::uint64_t pause_us = 0) {
  RunStatistics statistics;
  FrameAssembler assembler([&](const GridFrame& frame) { statistics.add(frame); });
  const auto target = std::make_unique<OfflineTarget>(
      vehicle, [&](std::span<const std::byte> message) { assembler.take(message); });
  for (std::size_t frame = 0; frame < drive.packets.size(); ++frame) {
    auto datagrams = drive.packets[frame];
    if (shuffled != nullptr) {
      const std::uint64_t end_us = datagrams.back().time_us;
      for (std::size_t last = datagrams.size(); last > 1; --last) {
        std::swap(datagrams[last - 1], datagrams[shuffled->below(last)]);
      }
      for (CapturedDatagram& datagram : datagrams) {
        datagram.time_us = end_us;
      }
    }
    for (CapturedDatagram& datagram : drive.with_poses(frame, std::move(datagrams))) {
      datagram.time_us += pause_us * frame;
      static_cast<void>(target->take(datagram));
    }
  }
  target->finish();
  assembler.finish();
  return statistics;
}

// Of all of its frames.
std::uint32_t causes_of(const RunStatistics& run) {
  std::uint32_t causes = 0;
  for (const ClassRecord& record : run.classes().records()) {
    causes |= record.causes;
  }
  return causes;
}

// docs/model.md, section 3: the join of a frame's slices is the frame.
TEST(ClassTarget, TheGridsAreThoseWithoutClasses) {
  const PlacedDrive drive(5);
  vehicle::Vehicle plain = *four_lux().vehicle;
  plain.grids = vehicle::Grids::kIndexes;
  const RunStatistics without = fused(plain, drive);
  const RunStatistics with = fused(*four_lux().vehicle, drive);
  ASSERT_EQ(without.records().size(), 5U);
  EXPECT_TRUE(without.classes().records().empty());
  EXPECT_EQ(with.classes().records().size(), 5U);
  EXPECT_EQ(with.run_hash(), without.run_hash());
  EXPECT_EQ(with.points_used(), without.points_used());
}

TEST(ClassTarget, TheClassesAreThoseWithoutTheOtherGrid) {
  const PlacedDrive drive(5);
  vehicle::Vehicle alone = *four_lux().vehicle;
  alone.grids = vehicle::Grids::kClasses;
  const RunStatistics without = fused(alone, drive);
  const RunStatistics with = fused(*four_lux().vehicle, drive);
  ASSERT_EQ(without.classes().records().size(), 5U);
  EXPECT_EQ(without.classes().run_hash(), with.classes().run_hash());
  EXPECT_EQ(without.incomplete() + without.classes().incomplete(), 0U);
  EXPECT_EQ(without.objects().run_hash(), with.objects().run_hash());
  EXPECT_EQ(without.objects().incomplete(), 0U);
}

TEST(ClassTarget, NoOrderOfPacketsShows) {
  const PlacedDrive drive(5);
  const RunStatistics in_order = fused(*four_lux().vehicle, drive);
  tests::Random random(841);
  const RunStatistics shuffled = fused(*four_lux().vehicle, drive, &random);
  ASSERT_EQ(in_order.classes().records().size(), 5U);
  EXPECT_EQ(first_difference(shuffled.classes().records(), in_order.classes().records()),
            std::nullopt);
  EXPECT_EQ(shuffled.objects().run_hash(), in_order.objects().run_hash());
  EXPECT_GT(in_order.objects().objects(), 0U);
  for (const ClassRecord& record : in_order.classes().records()) {
    EXPECT_EQ(record.packets_not_placed, 0U);
    EXPECT_GT(record.slices, 3U);
  }
}

// As in lockstep with a slow target: silent frames lie between those of the drive.
TEST(ClassTarget, NoPauseOfTheSenderShows) {
  const PlacedDrive drive(8);
  const RunStatistics flowing = fused(*four_lux().vehicle, drive);
  const RunStatistics pausing = fused(*four_lux().vehicle, drive, nullptr, 300'000);
  ASSERT_EQ(flowing.classes().records().size(), 8U);
  EXPECT_GT(pausing.classes().frames(), 2 * flowing.classes().frames());
  EXPECT_EQ(first_difference(pausing.classes().records(), flowing.classes().records()),
            std::nullopt);
}

// Every compiler and machine must get these classes; whoever changes the world or the rules on
// purpose pins anew.
TEST(ClassTarget, ClassesArePinned) {
  const RunStatistics run = fused(*four_lux().vehicle, PlacedDrive(10));
  ASSERT_EQ(run.classes().records().size(), 10U);
  EXPECT_GT(run.classes().records().back().tiles, 100U);
  EXPECT_EQ(run.classes().run_hash(), 0xC72A55A0U);
}

TEST(ClassTarget, FactsHaveTheFramesOfEachSensor) {
  const RunStatistics run = fused(*four_lux().vehicle, PlacedDrive(10));
  EXPECT_NE(run.table(false).find("\nsensor 3              10 complete\n"), std::string::npos)
      << run.table(false);
  const Facts facts = run.facts();
  std::map<std::string, std::string> values(facts.begin(), facts.end());
  EXPECT_EQ(values["sensor_3_complete"], "10");
  EXPECT_EQ(values["sensor_3_never_seen"] + values["sensor_3_partial"] + values["sensor_3_blocked"],
            "000");
  EXPECT_FALSE(values.contains("sensor_4_complete"));
}

// What the cells around the hits of moving tracks are called, as far as they lie in the track's
// box.
struct CellsBeside {
  void begin_frame(const stream::Header& /*header*/) {}
  void take_tile(std::size_t /*tile*/, tile_coding::TileCells /*cells*/) {}
  void end_frame() {}
  void take_classes(const stream::ClassEnd& /*end*/, const window::WindowView& classes) {
    const objects::Tracker& tracker = engine->objects();
    for (const objects::FrameHit& hit : tracker.hits()) {
      if (!tracker.is_moving(hit)) {
        continue;
      }
      const objects::Box& box = tracker.tracks()[static_cast<std::size_t>(hit.owner)].box();
      for (std::int32_t i = 0; i < 9; ++i) {
        const geometry::Cell cell{hit.cell.x + i % 3 - 1, hit.cell.y + i / 3 - 1};
        if (box.outside(objects::centre_of(cell)) == 0) {
          const auto name = decision::class_of(classes.name_of(cell));
          moving += name == decision::Class::kMoving ? 1 : 0;
          occupied += name == decision::Class::kOccupied ? 1 : 0;
        }
      }
    }
  }

  const app::PerceptionEngine* engine = nullptr;
  int moving = 0;
  int occupied = 0;
};

// docs/objects.md, "Labels": such a cell was hit in a turn before, and is a part of what moves.
TEST(ClassTarget, NoCellBesideAMovingHitAndInItsBoxIsOccupied) {
  constexpr std::uint32_t kReplayer = 0x0A000202;
  const PlacedDrive drive(75);
  tests::FakePlatform platform;
  CellsBeside beside;
  const auto pipeline = std::make_unique<app::PerceptionPipeline<tests::FakePlatform, CellsBeside>>(
      *four_lux().vehicle, kReplayer, platform, beside);
  beside.engine = &pipeline->perception();
  for (std::size_t frame = 0; frame < drive.packets.size(); ++frame) {
    for (const CapturedDatagram& datagram : drive.with_poses(frame, drive.packets[frame])) {
      pipeline->take({kReplayer, datagram.destination.port, datagram.payload},
                     datagram.time_us - kDriveStartUs);
    }
  }
  EXPECT_GT(beside.moving, 1'000);
  EXPECT_EQ(beside.occupied, 0);
}

// A source of poses that is stuck while the car drives on says nothing wrong of itself. Beams go
// through what stands, and within half a second the window is not believed.
TEST(ClassTarget, PosesThatAreStuckAreContradictedByTheSensors) {
  constexpr double kStuckS = 1;
  const auto run = [](std::uint32_t frames, const PoseOptions& options) {
    const RunStatistics statistics = fused(*four_lux().vehicle, PlacedDrive(frames, options));
    return statistics.classes().records();
  };
  const auto is_contradicted = [](const ClassRecord& record) {
    return (record.causes & stream::kCauseContradicted) != 0;
  };
  EXPECT_TRUE(std::ranges::none_of(run(90, {}), is_contradicted));
  const auto stuck = run(40, {.freezes = {{.begin_s = kStuckS, .length_s = 10}}});
  const auto first = std::ranges::find_if(stuck, is_contradicted);
  ASSERT_NE(first, stuck.end());
  const double after_s = static_cast<double>(first - stuck.begin()) / 25 - kStuckS;
  EXPECT_GT(after_s, 0);
  EXPECT_LE(after_s, 0.5);
  for (auto record = first; record != stuck.end(); ++record) {
    ASSERT_TRUE(is_contradicted(*record));
    ASSERT_EQ(record->packets_placed, 0U);
    ASSERT_EQ(record->tiles, 0U) << "what was known has lost its place";
  }
}

// One that is stuck from its first message on: little comes to stand, and much of it is crossed.
TEST(ClassTarget, PosesThatHaveNeverMovedAreContradictedByTheSensors) {
  const PlacedDrive drive(200, {.freezes = {{.begin_s = 0, .length_s = 10}}});
  const RunStatistics statistics = fused(*four_lux().vehicle, drive);
  EXPECT_TRUE(std::ranges::any_of(statistics.classes().records(), [](const ClassRecord& record) {
    return (record.causes & stream::kCauseContradicted) != 0 && record.tiles == 0;
  }));
}

// Held back by 8 % of the time, a pose is 80 ms late in a second, so no slice is ever late. Where
// packets get their time by when they come, that is told; where sensors have the clock of the
// poses, what is placed is placed rightly, and nothing by a pose that is over 100 ms old.
TEST(ClassTarget, PosesThatAreHeldBackMoreAndMorePlaceNothing) {
  vehicle::Vehicle by_arrival = *four_lux().vehicle;
  std::vector<vehicle::Sensor> sensors(by_arrival.sensors.begin(), by_arrival.sensors.end());
  std::ranges::for_each(sensors, [](vehicle::Sensor& one) { one.is_synchronised = false; });
  by_arrival.sensors = sensors;
  PlacedDrive drive(100);
  EXPECT_EQ(causes_of(fused(by_arrival, drive)) & stream::kCauseDrifting, 0U);
  const std::uint64_t begin_us = drive.packets.front().front().time_us;
  std::vector<CapturedDatagram> poses;
  for (auto& of_frame : drive.poses) {
    std::ranges::move(of_frame, std::back_inserter(poses));
    of_frame.clear();
  }
  for (CapturedDatagram& pose : poses) {
    pose.time_us += (pose.time_us - std::min(begin_us, pose.time_us)) * 8 / 100;
    const auto frame = std::ranges::find_if(
        drive.packets, [&](const auto& packets) { return packets.back().time_us >= pose.time_us; });
    if (frame != drive.packets.end()) {
      drive.poses[static_cast<std::size_t>(frame - drive.packets.begin())].push_back(pose);
    }
  }
  const RunStatistics held = fused(by_arrival, drive);
  EXPECT_NE(causes_of(held) & stream::kCauseDrifting, 0U);
  EXPECT_EQ(held.classes().records().back().packets_placed, 0U);
  const RunStatistics late = fused(*four_lux().vehicle, drive);
  EXPECT_EQ(causes_of(late), std::uint32_t{stream::kCauseLate});
  EXPECT_EQ(late.classes().records().back().packets_placed, 0U) << "320 ms";
}

TEST(ClassTarget, AnotherRuleIsRefusedWithItsReason) {
  vehicle::Vehicle bayes = *four_lux().vehicle;
  bayes.rule = vehicle::FusionRule::kBayes;
  try {
    const auto target = std::make_unique<OfflineTarget>(bayes, [](std::span<const std::byte>) {});
    FAIL() << "it was taken";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("bayes"), std::string::npos) << error.what();
  }
  bayes.grids = vehicle::Grids::kIndexes;
  EXPECT_NO_THROW(
      static_cast<void>(std::make_unique<OfflineTarget>(bayes, [](std::span<const std::byte>) {})));
}

}  // namespace
}  // namespace iog::tools
