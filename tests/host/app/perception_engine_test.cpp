// The walk into the window: which packets are placed, where, and what shows when they are not.
#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>
#include <memory>
#include <set>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "perception_bench.hpp"

namespace iog::app {
namespace {

using testing::Car;
using testing::drive_at_wall;
using testing::kPeriodUs;
using testing::kReplayer;
using testing::kStartUs;
using testing::PerceptionBench;
using testing::TimedDatagram;

bool is_occupied(int what) { return what >= static_cast<int>(decision::Class::kMoving); }

// The car has gone 8 m while it looked: what it hit lies in one row of cells all the same, since a
// slice of 8 ms at 10 m/s is off by 4 cm at most, and a cell of the grid and one of the window that
// share a centre by 0.071 m each.
TEST(PerceptionEngine, HitsLieWhereTheyAreInTheWorld) {
  const Car car(tests::OneLux::kVehicle, true);
  PerceptionBench bench(car.vehicle());
  bench.take(drive_at_wall(20));
  ASSERT_EQ(bench.classes.reports.size(), 20U);
  int occupied = 0;
  for (const testing::ClassList::Cell& cell : bench.classes.cells) {
    if (is_occupied(cell.what)) {
      ++occupied;
      ASSERT_NEAR((cell.at.x + 0.5) / 10, testing::kWallM, 0.05 + 0.04 + 0.142 + 0.005)
          << cell.at.y;
    }
    ASSERT_LE(cell.at.x, 302);
  }
  EXPECT_GT(occupied, 200);
  EXPECT_EQ(bench.end().packets_placed, 4U);
  EXPECT_EQ(bench.end().packets_not_placed, 0U);
  EXPECT_EQ(bench.slices_by(pose::Cause::kNone), 20U * 2);
}

// Contract of docs/spec.md, section 5.3: packets of the same 8 ms, and the pose of the middle.
TEST(PerceptionEngine, ASliceHasThePoseOfItsMiddle) {
  const Car car(tests::OneLux::kVehicle, true);
  PerceptionBench bench(car.vehicle());
  bench.take(drive_at_wall(10));
  for (std::size_t frame = 0; frame < 10; ++frame) {
    const auto& report = bench.classes.reports[frame];
    std::set<std::uint64_t> numbers;
    for (const std::uint64_t middle_us : {1250U, 3750U, 6250U, 8750U}) {
      numbers.insert((kStartUs + (frame + 1) * kPeriodUs - 10'000 + middle_us) / 8'000);
    }
    ASSERT_EQ(report.end.slice_count, numbers.size());
    auto number = numbers.begin();
    for (std::size_t i = 0; i < report.end.slice_count; ++i, ++number) {
      const std::uint64_t middle_us = *number * 8'000 + 4'000;
      EXPECT_EQ(report.end.slices[i].middle_us, middle_us);
      EXPECT_NEAR(report.end.slices[i].pose.x_mm,
                  1000 * testing::x_at(static_cast<double>(middle_us - kStartUs)), 1);
    }
    EXPECT_EQ(report.stamp_us, (*numbers.rbegin() + 1) * 8'000);
  }
}

// Three sensors that sweep one after the other, and at the same time.
std::vector<TimedDatagram> frame_of_three_walls(int number) {
  std::vector<TimedDatagram> frame;
  for (const int sensor : {0, 1, 2}) {
    const std::uint64_t end_us =
        static_cast<std::uint64_t>(number) * kPeriodUs - 3'000 * static_cast<std::uint64_t>(sensor);
    std::ranges::move(testing::scan_of_wall(static_cast<std::uint16_t>(100 + sensor), number, 2,
                                            end_us, 25 + 4 * sensor),
                      std::back_inserter(frame));
  }
  return frame;
}

// Frames 1 ... 4; packets of a frame all come when it ends, in any order.
std::vector<TimedDatagram> shuffled_drive(tests::Random* random) {
  std::vector<TimedDatagram> drive;
  for (int number = 1; number <= 4; ++number) {
    auto frame = frame_of_three_walls(number);
    for (std::size_t last = frame.size(); random != nullptr && last > 1; --last) {
      std::swap(frame[last - 1], frame[random->below(last)]);
    }
    for (TimedDatagram& datagram : frame) {
      datagram.now_us = static_cast<std::uint64_t>(number) * kPeriodUs;
    }
    std::ranges::move(frame, std::back_inserter(drive));
  }
  std::ranges::move(testing::poses(0, 4 * kPeriodUs), std::back_inserter(drive));
  return drive;
}

TEST(PerceptionEngine, NoOrderOfPacketsShows) {
  const Car car(tests::ThreeLux::kVehicle, true);
  PerceptionBench in_order(car.vehicle());
  in_order.take(shuffled_drive(nullptr));
  ASSERT_EQ(in_order.classes.names.size(), 4U);
  EXPECT_GT(in_order.end().slice_count, 1U);
  EXPECT_GT(in_order.classes.names.back().tiles, 10U);
  tests::Random random(831);
  for (int i = 0; i < tests::effort(40, 4); ++i) {
    PerceptionBench shuffled(car.vehicle());
    shuffled.take(shuffled_drive(&random));
    ASSERT_EQ(shuffled.classes.names, in_order.classes.names);
    for (std::size_t frame = 0; frame < 4; ++frame) {
      ASSERT_EQ(shuffled.platform.frames[frame].end.grid_crc,
                in_order.platform.frames[frame].end.grid_crc);
    }
  }
}

// docs/model.md, section 3: with or without slices, placed or not, the frame's grid is the same.
TEST(PerceptionEngine, TheFramesGridIsThatOfTheWholeFrame) {
  const Car car(tests::ThreeLux::kVehicle, true);
  PerceptionBench placed(car.vehicle());
  placed.take(shuffled_drive(nullptr));
  PerceptionBench lost(car.vehicle());
  tests::FakePlatform platform;
  const auto whole =
      std::make_unique<Pipeline<tests::FakePlatform>>(car.vehicle(), kReplayer, platform);
  for (int number = 1; number <= 4; ++number) {
    for (TimedDatagram datagram : frame_of_three_walls(number)) {
      datagram.now_us = static_cast<std::uint64_t>(number) * kPeriodUs;
      lost.take({datagram});
      whole->take({kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
    }
  }
  ASSERT_EQ(platform.frames.size(), 4U);
  for (std::size_t frame = 0; frame < 4; ++frame) {
    EXPECT_TRUE(placed.platform.frames[frame].cells == platform.frames[frame].cells);
    EXPECT_TRUE(lost.platform.frames[frame].cells == platform.frames[frame].cells);
    EXPECT_EQ(placed.platform.frames[frame].end.fates, platform.frames[frame].end.fates);
  }
  EXPECT_EQ(lost.end().packets_placed, 0U);
  EXPECT_EQ(lost.end().packets_not_placed, 6U);
  EXPECT_EQ(lost.classes.names.back(), testing::ClassName{});
  EXPECT_GT(placed.classes.names.back().tiles, 0U);
}

// Sensors whose packets come 7 ms after their measurement, and poses that come 2 ms after theirs:
// what their clocks would say is found out by when they come.
TEST(PerceptionEngine, ASensorWithoutClockIsPlacedByWhenItsPacketsCame) {
  const Car by_clock(tests::OneLux::kVehicle, true);
  const Car by_arrival(tests::OneLux::kVehicle, false, 7'000);
  auto drive = drive_at_wall(8);
  for (TimedDatagram& datagram : drive) {
    if (datagram.port != pose::kPosePort) {
      const lidar::PacketInfo info =
          intake::Packet::decode(lidar::kFormat<lidar::IbeoLux>, datagram.bytes).info();
      const std::int32_t right = info.sector.first_ticks > 5760 ? info.sector.first_ticks - 11520
                                                                : info.sector.first_ticks;
      const std::int32_t middle = right + info.sector.width_ticks / 2;
      datagram.now_us +=
          static_cast<std::uint64_t>((1600 - middle) * 10'000 / 3200) - 10'000 + 7'000;
    }
  }
  PerceptionBench synchronised(by_clock.vehicle());
  synchronised.take(drive);
  PerceptionBench arrived(by_arrival.vehicle());
  arrived.take(drive);
  EXPECT_EQ(arrived.classes.names, synchronised.classes.names);
  EXPECT_EQ(arrived.end().packets_placed, 4U);
}

// More packets than a frame keeps: the first that finds no room ends it, and belongs to the next.
// They are of one scan and without points, and the last one is of another sensor.
TEST(PerceptionEngine, APacketThatFindsNoRoomEndsTheFrame) {
  const Car car(tests::ThreeLux::kVehicle, true);
  PerceptionBench bench(car.vehicle());
  std::vector<TimedDatagram> packets;
  for (std::uint64_t i = 0; i <= fusion::kMaxFramePackets; ++i) {
    const tests::LuxMessage message{
        .start_ticks = 10, .end_ticks = 0, .points = {}, .start_ntp = i + 1, .end_ntp = i + 2};
    packets.push_back({1'000, static_cast<std::uint16_t>(i < fusion::kMaxFramePackets ? 100 : 101),
                       message.bytes()});
  }
  bench.take(packets);
  bench.pass_until(41'000);
  ASSERT_EQ(bench.platform.frames.size(), 2U);
  EXPECT_EQ(bench.platform.frames[0].header.packets_fused, fusion::kMaxFramePackets);
  EXPECT_EQ(bench.platform.frames[1].header.packets_fused, 1U);
  EXPECT_EQ(bench.platform.frames[1].header.packets_dropped, 0U);
}

// Of slices of 1 ms there are more than the engine places: the rest only counts in the frame.
TEST(PerceptionEngine, SlicesAreBounded) {
  const Car car(tests::OneLux::kVehicle, true);
  vehicle::Vehicle fine = car.vehicle();
  fine.poses.log2_slice_ms = 0;
  PerceptionBench bench(fine);
  auto drive = testing::poses(0, 200'000);
  std::vector<TimedDatagram> packets;
  for (int i = 0; i < 50; ++i) {
    const std::uint64_t end_us = 100'000 + 1'000 * static_cast<std::uint64_t>(i);
    auto scan = testing::scan_of_wall(100, 1, 1, end_us, 20);
    scan[0].now_us = 190'000;
    // One beam, straight on: fifty sectors of one scan, each with a time of its own.
    const int ticks = 1600 - 16 * i;
    scan[0].bytes =
        tests::LuxMessage{.start_ticks = ticks,
                          .end_ticks = ticks - 16,
                          .points = {{.layer = 2, .angle_ticks = ticks - 8, .range_cm = 2000}},
                          .start_ntp = testing::ntp_of(kStartUs + end_us),
                          .end_ntp = testing::ntp_of(kStartUs + end_us)}
            .bytes();
    packets.push_back(scan[0]);
  }
  bench.take(drive);
  bench.take(packets);
  bench.pass_until(240'000);
  EXPECT_EQ(bench.classes.reports[1].end.slice_count + bench.classes.reports[0].end.slice_count +
                bench.end().slice_count,
            fusion::kMaxSlices);
  std::uint32_t over = 0;
  std::uint32_t not_placed = 0;
  for (const auto& report : bench.classes.reports) {
    over += report.end.slices_over_budget;
    not_placed += report.end.packets_not_placed;
  }
  EXPECT_EQ(over, 50U - fusion::kMaxSlices);
  EXPECT_EQ(not_placed, 50U - fusion::kMaxSlices);
}

// Section 3 of docs/model.md: only hits_win from zero joins, and only blurring marks hits alone.
TEST(PerceptionEngine, OtherRulesHaveNoPerceptionGrid) {
  EXPECT_EQ(unfit_for_perception(tests::OneLux::kVehicle), Unfit::kNone);
  EXPECT_EQ(unfit_for_perception(tests::OneLuxNearest::kVehicle), Unfit::kQuantisation);
  vehicle::Vehicle bayes = tests::OneLux::kVehicle;
  bayes.rule = vehicle::FusionRule::kBayes;
  EXPECT_EQ(unfit_for_perception(bayes), Unfit::kFusionRule);
}

}  // namespace
}  // namespace iog::app
