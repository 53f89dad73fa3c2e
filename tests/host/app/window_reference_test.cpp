// What the engine makes of drives of a LUX and of a VLP-16, against plain loops over the grid of
// each frame, in windows of several sides. A car drives along x by whole cells from frame to frame,
// out of what it has seen, and its poses jump once.
#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "fakes/effort.hpp"
#include "perception/plain_fusion.hpp"
#include "shared_drives.hpp"

namespace iog::app {
namespace {

using testing::Drive;
using testing::kStartUs;

// Frames are slices, so that the grid of a frame is that of its slice.
constexpr std::uint8_t kLog2SliceMs = 6;
constexpr std::uint64_t kFrameUs = 64'000;
constexpr std::int32_t kMmPerMs = 25;  // 16 cells a frame
constexpr std::int32_t kJumpMm = 100'000;

std::int32_t x_mm_at(std::uint64_t time_us, std::uint64_t jump_us) {
  return static_cast<std::int32_t>(time_us * kMmPerMs / 1000) + (time_us < jump_us ? 0 : kJumpMm);
}

Drive poses_of(std::uint64_t end_us, std::uint64_t jump_us) {
  Drive drive;
  for (std::uint64_t time_us = 0; time_us < end_us; time_us += 8'000) {
    pose::Message message = testing::pose_at(time_us);
    message.pose.x_mm = x_mm_at(time_us, jump_us);
    message.speed_mm_per_s = 1000 * kMmPerMs;
    drive.push_back(testing::datagram_of(message));
  }
  return drive;
}

// Walls of any range in front of the car, which stay for some frames; at each frame's end a scan.
Drive scans_of_lux(int frames) {
  Drive drive;
  tests::Random random(8);
  for (int frame = 1; frame <= frames; ++frame) {
    const std::uint64_t begin_us = static_cast<std::uint64_t>(frame) * kFrameUs + 10'000;
    tests::LuxMessage scan{.scan_number = frame,
                           .start_ticks = 1600,
                           .end_ticks = -1600,
                           .points = {},
                           .start_ntp = testing::ntp_of(kStartUs + begin_us),
                           .end_ntp = testing::ntp_of(kStartUs + begin_us + 10'000)};
    int range_cm = 2'000;
    for (int ticks = 1600; ticks > -1600; ticks -= 16) {
      range_cm = random.one_in(9) ? random.between(300, 4'800) : range_cm;
      scan.points.push_back({.layer = 2, .angle_ticks = ticks, .range_cm = range_cm});
    }
    drive.push_back({begin_us + 12'000, 100, scan.bytes()});
  }
  return drive;
}

// A third of a turn in each slice.
Drive thirds_of_turns() {
  constexpr std::size_t kPacketsOfThird = testing::kPacketsOfTurn / 3;
  Drive drive = testing::turns_of_vlp16(100, 6, false, 25'000);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    drive[i].now_us = (1 + i / kPacketsOfThird) * kFrameUs + 5'000 + 800 * (i % kPacketsOfThird);
  }
  return drive;
}

// The index grid of the newest frame, and what the engine makes of it, against PlainFusion.
class Comparison {
 public:
  explicit Comparison(window::Extent extent) : extent_(extent) { forget(); }

  void watch(const PerceptionEngine& engine) { engine_ = &engine; }
  void begin_frame(const stream::Header& /*header*/) { slice_ = {}; }
  void take_tile(std::size_t tile, tile_coding::TileCells cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const geometry::Cell at{static_cast<std::int32_t>(tile % 32 * 32 + i % 32),
                              static_cast<std::int32_t>(tile / 32 * 32 + i / 32)};
      if (cells[i] != std::byte{0}) {
        slice_.set(at, static_cast<std::int8_t>(cells[i]));
      }
    }
  }
  void end_frame() {}
  void take_classes(const stream::ClassEnd& end, const window::WindowView& classes) {
    if (engine_->is_forgotten()) {
      forget();
      ++forgotten;
    }
    ASSERT_LE(end.slice_count, 1U);
    if (end.slice_count == 1) {
      const pose::Pose& pose = engine_->slices().front().pose;
      ASSERT_EQ(pose.y_mm, 0);
      const geometry::Cell vehicle{(pose.x_mm + 50) / 100, 0};
      ASSERT_LE(std::abs(pose.x_mm - 100 * vehicle.x), 2);
      plain_->follow(vehicle);
      is_placed_ = true;
      plain_->frame({{.slice = slice_, .vehicle = vehicle}}, engine_->stamp_us());
    } else if (is_placed_) {
      plain_->frame({}, engine_->stamp_us());
    }
    compare(classes);
  }

  std::set<std::int32_t> corners;
  int forgotten = 0;
  std::size_t known = 0;  // cells that have a class
  std::size_t most_tiles = 0;

 private:
  void forget() {
    plain_ = std::make_unique<tests::PlainFusion>(false, 3, true, tests::Looks{}, extent_);
    is_placed_ = false;
  }
  void compare(const window::WindowView& classes) {
    corners.insert(classes.area().corner().a);
    std::size_t tiles = 0;
    for (const auto& [number, tile] : plain_->tiles()) {
      const std::size_t slot = window::slot_of({number.second, number.first});
      std::array<std::int8_t, geometry::kTileCells> bytes{};
      classes.copy_classes(slot, bytes);
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        ASSERT_EQ(int{bytes[i]}, int{tile.groups[i / 8].decided[i % 8]}) << engine_->stamp_us();
        known += bytes[i] != 0 ? 1U : 0U;
      }
      ++tiles;
    }
    most_tiles = std::max(most_tiles, tiles);
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      tiles -= classes.is_known(slot) ? 1U : 0U;
    }
    ASSERT_EQ(tiles, 0U);
  }

  window::Extent extent_;
  const PerceptionEngine* engine_ = nullptr;
  tests::Slice slice_;
  std::unique_ptr<tests::PlainFusion> plain_;
  bool is_placed_ = false;
};

constexpr int kFrames = 20;
constexpr std::uint64_t kJumpUs = kFrameUs * kFrames * 2 / 3;
constexpr std::uint64_t kEndUs = kFrameUs * (kFrames + 2);

void expect_what_plain_loops_make(const vehicle::Vehicle& like, window::Extent extent,
                                  bool is_synchronised, const Drive& drive, std::size_t cores) {
  testing::Car synchronised(like, is_synchronised);
  vehicle::Vehicle car = synchronised.vehicle();
  car.grids = vehicle::Grids::kBoth;
  car.has_objects = false;
  car.window.extent = extent;
  car.poses.log2_slice_ms = kLog2SliceMs;
  car.frame_period_us = 60'000;  // from the first packet, so that it ends before the next slice's
  testing::SharingPlatform platform(cores, testing::kAnyTimeUs);
  Comparison comparison(extent);
  const auto pipeline = std::make_unique<PerceptionPipeline<testing::SharingPlatform, Comparison>>(
      car, testing::kReplayer, platform, comparison);
  comparison.watch(pipeline->perception());
  testing::take(*pipeline, drive);
  EXPECT_GT(comparison.corners.size(), 8U);
  EXPECT_EQ(comparison.forgotten, 1);
  EXPECT_GT(comparison.known, 100'000U);
  EXPECT_LE(comparison.most_tiles, extent.tile_count());
}

struct WindowCase {
  window::Extent extent;
  std::size_t cores;
};
constexpr WindowCase kWindows[] = {{{12, 7}, 1}, {{5, 9}, 4}};

TEST(WindowReference, ADriveOfALuxIsWhatPlainLoopsMakeOfIt) {
  Drive drive = poses_of(kEndUs, kJumpUs);
  std::ranges::move(scans_of_lux(kFrames), std::back_inserter(drive));
  for (const auto& [extent, cores] : kWindows) {
    ASSERT_NO_FATAL_FAILURE(expect_what_plain_loops_make(tests::OneLux::kVehicle, extent, true,
                                                         testing::sorted(drive), cores));
  }
}

TEST(WindowReference, ADriveOfAVlp16IsWhatPlainLoopsMakeOfIt) {
  Drive drive = poses_of(kEndUs, kJumpUs);
  std::ranges::move(thirds_of_turns(), std::back_inserter(drive));
  for (const auto& [extent, cores] : kWindows) {
    ASSERT_NO_FATAL_FAILURE(expect_what_plain_loops_make(tests::LevelVlp16::kVehicle, extent, false,
                                                         testing::sorted(drive), cores));
  }
}

}  // namespace
}  // namespace iog::app
