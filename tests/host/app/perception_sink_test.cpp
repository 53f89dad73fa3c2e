// What the network gets of a frame with classes (docs/spec.md 3.2, 3.9 and 3.10), read back from
// the messages.
#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "app/pipeline.hpp"
#include "fakes/fake_platform.hpp"
#include "fakes/test_vehicles.hpp"
#include "perception_drive.hpp"

namespace iog::app {
namespace {

using testing::kPeriodUs;
using testing::kStartUs;
using testing::TimedDatagram;
using tests::FakePlatform;
using tests::ReceivedFrame;

constexpr int kClassTiles = 10 + static_cast<int>(stream::Storage::kClass);
constexpr int kIndexTiles = 10 + static_cast<int>(stream::Storage::kOccupancyIndex);
constexpr int kClassEnd = static_cast<int>(stream::MessageType::kClassEnd);
constexpr int kFrameEnd = static_cast<int>(stream::MessageType::kFrameEnd);

// Keeps the class bytes of every frame, by number in messages, as the window shows them.
class ShownClasses {
 public:
  using Tiles = std::map<std::size_t, std::pair<int, std::vector<std::int8_t>>>;

  void begin_frame(const stream::Header& /*header*/) {}
  void take_tile(std::size_t /*tile*/, tile_coding::TileCells /*cells*/) {}
  void end_frame() {}
  void take_classes(const stream::ClassEnd& /*end*/, const window::WindowView& classes) {
    const auto [columns, rows] = classes.area().extent();
    corners.push_back(classes.area().corner());
    Tiles tiles;
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      std::vector<std::int8_t> cells(geometry::kTileCells);
      classes.copy_classes(slot, std::span(cells).first<geometry::kTileCells>());
      if (std::ranges::any_of(cells, [](std::int8_t cell) { return cell != 0; })) {
        const window::TileNumber tile = classes.area().tile_at(slot);
        const auto remainder = [](std::int32_t n, std::int32_t by) { return (n % by + by) % by; };
        tiles[static_cast<std::size_t>(remainder(tile.b, rows) * columns +
                                       remainder(tile.a, columns))] = {classes.age_frames(slot),
                                                                       cells};
      }
    }
    frames.push_back(std::move(tiles));
  }

  std::vector<window::TileNumber> corners;
  std::vector<Tiles> frames;
};

struct ClassBench {
  explicit ClassBench(vehicle::Grids grids, Coding coding = Coding::kShortest,
                      window::Extent extent = {})
      : car(tests::OneLux::kVehicle, true), vehicle(car.vehicle()) {
    vehicle.grids = grids;
    vehicle.window.extent = extent;
    pipeline = std::make_unique<PerceptionPipeline<FakePlatform, ShownClasses>>(
        vehicle, testing::kReplayer, platform, coding, shown);
  }

  void take(std::vector<TimedDatagram> datagrams) {
    std::ranges::stable_sort(datagrams, {}, &TimedDatagram::now_us);
    for (const TimedDatagram& datagram : datagrams) {
      pass_until(datagram.now_us);
      pipeline->take({testing::kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
    }
  }
  void pass_until(std::uint64_t now_us) {
    while (pipeline->deadline_us() <= now_us) {
      pipeline->tick(pipeline->deadline_us());
    }
  }

  testing::Car car;
  vehicle::Vehicle vehicle;
  FakePlatform platform;
  ShownClasses shown;
  std::unique_ptr<PerceptionPipeline<FakePlatform, ShownClasses>> pipeline;
};

// Frames first ... last, each a scan of a wall that ends with its period; without its poses.
std::vector<TimedDatagram> scans(int first, int last) {
  std::vector<TimedDatagram> datagrams;
  for (int frame = first; frame <= last; ++frame) {
    std::ranges::move(
        testing::scan_of_wall(100, frame, 4, static_cast<std::uint64_t>(frame) * kPeriodUs, 30.04),
        std::back_inserter(datagrams));
  }
  return datagrams;
}

std::vector<TimedDatagram> class_drive(int count) {
  auto drive = testing::poses(0, static_cast<std::uint64_t>(count) * kPeriodUs);
  std::ranges::move(scans(1, count), std::back_inserter(drive));
  return drive;
}

// The tiles that arrived are those of the window, and no others.
void expect_shown(const ReceivedFrame& received, const ShownClasses::Tiles& shown) {
  ASSERT_EQ(received.classes.size(), shown.size());
  for (const auto& [slot, tile] : shown) {
    const auto found = received.classes.find(slot);
    ASSERT_NE(found, received.classes.end()) << slot;
    EXPECT_EQ(int{found->second.age_frames}, tile.first) << slot;
    EXPECT_TRUE(std::ranges::equal(found->second.cells, std::as_bytes(std::span(tile.second))))
        << slot;
  }
}

// CRC-32/P4, bit by bit.
std::uint32_t crc_of(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t crc = 0xFFFF'FFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xC8DF'352F : 0);
    }
  }
  return ~crc;
}

// docs/spec.md 3.10: corner, then by number each tile's number and cells, big endian.
std::uint32_t name_of(const ReceivedFrame& frame) {
  std::vector<std::uint8_t> bytes;
  const auto append = [&](std::uint32_t value, int width) {
    for (int shift = 8 * (width - 1); shift >= 0; shift -= 8) {
      bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    }
  };
  append(static_cast<std::uint32_t>(frame.class_end->window.corner_a), 4);
  append(static_cast<std::uint32_t>(frame.class_end->window.corner_b), 4);
  for (const auto& [number, tile] : frame.classes) {
    append(static_cast<std::uint32_t>(number), 2);
    for (const std::byte cell : tile.cells) {
      bytes.push_back(std::to_integer<std::uint8_t>(cell));
    }
  }
  return frame.classes.empty() ? 0 : crc_of(bytes);
}

TEST(PerceptionSink, WhatArrivesIsTheWindow) {
  for (const Coding coding : {Coding::kShortest, Coding::kRaw}) {
    ClassBench bench(vehicle::Grids::kBoth, coding);
    bench.take(class_drive(20));
    ASSERT_EQ(bench.platform.frames.size(), 20U);
    EXPECT_EQ(bench.platform.unreadable(), 0);
    for (std::size_t i = 0; i < 20; ++i) {
      const ReceivedFrame& frame = bench.platform.frames[i];
      ASSERT_NO_FATAL_FAILURE(expect_shown(frame, bench.shown.frames[i]));
      ASSERT_TRUE(frame.class_end);
      EXPECT_EQ(frame.class_end->tiles_sent, frame.classes.size());
      EXPECT_EQ(frame.class_end->tiles_lost, 0U);
      EXPECT_EQ(frame.class_end->classes_crc, name_of(frame));
    }
    EXPECT_GT(bench.platform.frames.back().classes.size(), 30U);
  }
}

// A car of 10 m/s leaves tiles of a window of 12.8 x 22.4 m behind; each number is another tile's.
TEST(PerceptionSink, WhatArrivesIsTheWindowThatIsARectangle) {
  constexpr window::Extent kExtent{4, 7};
  ClassBench bench(vehicle::Grids::kClasses, Coding::kShortest, kExtent);
  bench.take(class_drive(60));
  ASSERT_EQ(bench.platform.frames.size(), 60U);
  EXPECT_EQ(bench.platform.unreadable(), 0);
  std::set<std::int32_t> corners;
  for (std::size_t i = 0; i < 60; ++i) {
    const ReceivedFrame& frame = bench.platform.frames[i];
    ASSERT_NO_FATAL_FAILURE(expect_shown(frame, bench.shown.frames[i]));
    EXPECT_EQ(frame.class_end->classes_crc, name_of(frame));
    EXPECT_EQ(frame.class_tiles_spoken_of, kExtent.tile_count());
    corners.insert(frame.class_end->window.corner_a);
  }
  EXPECT_GT(bench.platform.frames.back().classes.size(), 10U);
  EXPECT_GT(corners.size(), 5U);
}

// Against what was sent before, a tile that has hardly changed is short: 20 frames of some 100
// tiles are fewer messages than if each stood by itself.
TEST(PerceptionSink, TilesAreSentByWhatHasChanged) {
  // One after the other: the Cortex-A9's tests have memory for one.
  const auto messages_by = [](Coding coding) {
    ClassBench bench(vehicle::Grids::kClasses, coding);
    bench.take(class_drive(20));
    return bench.platform.tile_messages();
  };
  EXPECT_LT(5 * messages_by(Coding::kShortest), messages_by(Coding::kRaw));
}

// Section 3 of the specification: indexes, classes, their end, the frame's end.
TEST(PerceptionSink, MessagesComeInTheirOrder) {
  ClassBench bench(vehicle::Grids::kBoth);
  bench.take(class_drive(3));
  ASSERT_EQ(bench.platform.frames.size(), 3U);
  for (const ReceivedFrame& frame : bench.platform.frames) {
    std::vector<int> types = frame.message_types;
    EXPECT_EQ(frame.header.flags, stream::kFlagClasses);
    types.erase(std::unique(types.begin(), types.end()), types.end());
    EXPECT_EQ(types, (std::vector{kIndexTiles, kClassTiles, kClassEnd, kFrameEnd}));
  }
}

TEST(PerceptionSink, ClassesMayGoAlone) {
  ClassBench both(vehicle::Grids::kBoth);
  ClassBench alone(vehicle::Grids::kClasses);
  both.take(class_drive(3));
  alone.take(class_drive(3));
  ASSERT_EQ(alone.platform.frames.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const ReceivedFrame& frame = alone.platform.frames[i];
    EXPECT_EQ(frame.header.flags, stream::kFlagClasses | stream::kFlagNoIndexes);
    EXPECT_EQ(std::ranges::count(frame.message_types, kIndexTiles), 0);
    EXPECT_EQ(frame.end.tiles_sent + frame.end.tiles_lost + frame.end.grid_crc, 0U);
    EXPECT_EQ(frame.class_end->classes_crc, both.platform.frames[i].class_end->classes_crc);
    EXPECT_NE(frame.class_end->classes_crc, 0U);
  }
}

// The grid of the frame is the same, bit for bit, whether there are classes or not.
TEST(PerceptionSink, TheFramesGridsAreThoseWithoutClasses) {
  ClassBench bench(vehicle::Grids::kBoth);
  FakePlatform plain_platform;
  const auto plain = std::make_unique<Pipeline<FakePlatform>>(bench.car.vehicle(),
                                                              testing::kReplayer, plain_platform);
  bench.take(class_drive(5));
  for (const TimedDatagram& datagram : scans(1, 5)) {
    plain->take({testing::kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
  }
  ASSERT_EQ(plain_platform.frames.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const ReceivedFrame& without = plain_platform.frames[i];
    const ReceivedFrame& with = bench.platform.frames[i];
    EXPECT_EQ(without.header.flags, 0);
    EXPECT_FALSE(without.class_end);
    EXPECT_EQ(without.end.grid_crc, with.end.grid_crc);
    EXPECT_EQ(without.end.tiles_sent, with.end.tiles_sent);
    EXPECT_EQ(without.cells, with.cells);
  }
}

// The car is at 10 m/s along x. A scan of 10 ms that ends at 40 ms has slices of 8 ms from 24 or 32
// to 40 and to 48 on; its last packet is measured with its end.
TEST(PerceptionSink, TheWindowSaysWhereAndWhenTheFrameWas) {
  ClassBench bench(vehicle::Grids::kBoth);
  bench.take(class_drive(8));
  const ReceivedFrame& frame = bench.platform.frames[7];
  const stream::ClassWindow& window = frame.class_end->window;
  EXPECT_EQ(window.corner_a, bench.shown.corners[7].a);
  EXPECT_EQ(window.corner_b, bench.shown.corners[7].b);
  EXPECT_EQ(window.causes, 0);
  EXPECT_EQ(window.slice_ms, 8);
  ASSERT_GE(window.slices, 1);
  EXPECT_EQ(window.slices_begin_us % 8000, 0U);
  EXPECT_EQ(window.slices_end_us % 8000, 0U);
  EXPECT_GE(window.slices_end_us, window.slices_begin_us + std::uint64_t{8000} * window.slices);
  EXPECT_NEAR(window.pose.x_mm,
              1000 * testing::x_at(static_cast<double>(window.slices_end_us - kStartUs)), 1);
  EXPECT_EQ(window.sigma.position_mm, 10);
  EXPECT_EQ(window.sigma.heading_10urad, 10);
  for (const stream::ClassWindow& of_tiles : frame.windows) {
    EXPECT_EQ(of_tiles, window);
  }
  EXPECT_EQ(frame.class_end->slice_count, window.slices);
  EXPECT_EQ(frame.class_end->packets_placed, 4U);
  EXPECT_EQ(frame.class_end->packets_not_placed, 0U);
  for (std::size_t i = 0; i < window.slices; ++i) {
    const stream::SliceRecord& slice = frame.class_end->slices[i];
    EXPECT_EQ(slice.middle_us % 8000, 4000U);
    EXPECT_NEAR(slice.pose.x_mm,
                1000 * testing::x_at(static_cast<double>(slice.middle_us - kStartUs)), 1);
    EXPECT_EQ(slice.sigma, (pose::Sigma{10, 10}));
  }
}

// Of a frame that has no pose the pose is not known, which its deviations say; its cause is there
// as long as it lasts.
TEST(PerceptionSink, AFrameWithoutPosesSaysSo) {
  ClassBench bench(vehicle::Grids::kBoth);
  bench.take(scans(1, 2));
  for (const ReceivedFrame& frame : bench.platform.frames) {
    const stream::ClassWindow& window = frame.class_end->window;
    EXPECT_EQ(window.causes, stream::kCauseLost);
    EXPECT_EQ(window.slices, 0);
    EXPECT_EQ(window.pose, pose::Pose{});
    EXPECT_EQ(window.sigma.position_mm, 0xFFFF);
    EXPECT_EQ(window.sigma.heading_10urad, 0xFFFF);
    EXPECT_EQ(window.slices_begin_us, window.slices_end_us);
    EXPECT_EQ(frame.class_end->packets_not_placed, 4U);
    EXPECT_EQ(frame.class_end->classes_crc, 0U);
  }
  EXPECT_EQ(bench.platform.frames.size(), 2U);
}

TEST(PerceptionSink, CausesAreThoseSinceTheFrameBefore) {
  ClassBench bench(vehicle::Grids::kBoth);
  auto drive = scans(1, 20);
  std::ranges::move(testing::poses(0, 400'000), std::back_inserter(drive));
  std::ranges::move(testing::poses(600'000, 800'000), std::back_inserter(drive));
  bench.take(drive);
  ASSERT_EQ(bench.platform.frames.size(), 20U);
  const auto causes_of = [&](std::size_t frame) {
    return bench.platform.frames[frame].class_end->window.causes;
  };
  // Poses until 0.39 s carry 100 ms: the scan that ends at 0.48 s is placed, those up to 0.6 not.
  EXPECT_EQ(causes_of(11), 0);
  for (const std::size_t late : {12U, 13U}) {
    EXPECT_EQ(causes_of(late), stream::kCauseLate) << late;
  }
  EXPECT_EQ(causes_of(19), 0);
  const auto& late =
      bench.platform.frames[19].class_end->causes[static_cast<std::size_t>(pose::Cause::kLate)];
  EXPECT_EQ(late.began.times, 1U);
  EXPECT_GT(late.slices, 3U);
}

// When the network takes no more, class tiles are lost and counted, and leave no trace.
TEST(PerceptionSink, LostClassTilesAreCounted) {
  ClassBench bench(vehicle::Grids::kClasses, Coding::kRaw);
  auto drive = class_drive(5);
  const auto is_later = [](const TimedDatagram& datagram) {
    return datagram.now_us >= 4 * kPeriodUs;
  };
  std::ranges::stable_sort(drive, {}, &TimedDatagram::now_us);
  const auto later = std::ranges::find_if(drive, is_later);
  bench.take({drive.begin(), later});
  ASSERT_EQ(bench.platform.frames.size(), 3U);
  bench.platform.refuse_messages(7);
  bench.take({later, drive.end()});
  ASSERT_EQ(bench.platform.frames.size(), 5U);
  const ReceivedFrame& torn = bench.platform.frames[3];
  EXPECT_EQ(torn.class_end->tiles_lost, 7U);  // a raw tile fills a message
  EXPECT_EQ(torn.class_end->tiles_sent, torn.classes.size());
  EXPECT_EQ(torn.classes.size() + 7, bench.shown.frames[3].size());
  EXPECT_NE(torn.class_end->classes_crc, name_of(torn));
  const ReceivedFrame& next = bench.platform.frames[4];
  ASSERT_NO_FATAL_FAILURE(expect_shown(next, bench.shown.frames[4]));
  EXPECT_EQ(next.class_end->tiles_lost, 0U);
  EXPECT_EQ(next.class_end->classes_crc, name_of(next));
}

}  // namespace
}  // namespace iog::app
