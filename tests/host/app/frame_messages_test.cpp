// What a frame says of itself arrives in the stream's words (docs/spec.md 3.2 and 3.5).
#include "app/frame_messages.hpp"

#include <gtest/gtest.h>

namespace iog::app {
namespace {

using intake::SensorState;
using vehicle::Fate;

TEST(FrameMessages, TheHeaderHasABitForEachSensorAndSumsOfPoints) {
  FrameReport report{.number = 9, .closed_us = 77, .vehicle_id = 5, .sensor_count = 4};
  report.sensors[0].state = SensorState::kPartial;
  report.sensors[1].state = SensorState::kComplete;
  report.sensors[2].state = SensorState::kSilent;
  report.sensors[3].state = SensorState::kComplete;
  report.sensors[4].state = SensorState::kComplete;  // there is no such sensor
  report.fates[static_cast<std::size_t>(Fate::kUsed)] = 100;
  report.fates[static_cast<std::size_t>(Fate::kNoReturn)] = 20;
  report.fates[static_cast<std::size_t>(Fate::kMalformed)] = 3;
  report.packets_fused = 6;
  report.packets_dropped = 10;
  report.vitals.link_drops = 4;
  report.run_number = 0xF0000001;
  const stream::Header header = header_of(report);
  EXPECT_EQ(header.frame_number, 9U);
  EXPECT_EQ(header.closed_us, 77U);
  EXPECT_EQ(header.vehicle_id, 5U);
  EXPECT_EQ(header.sensor_count, 4);
  EXPECT_EQ(header.complete_sensors, 0b1010);
  EXPECT_EQ(header.partial_sensors, 0b0001);
  EXPECT_EQ(header.points_used, 100U);
  EXPECT_EQ(header.points_other, 23U);
  EXPECT_EQ(header.packets_fused, 6U);
  EXPECT_EQ(header.packets_dropped, 14U);
  EXPECT_EQ(header.flags, 0);
  EXPECT_EQ(header.run_number, 0xF0000001U);
}

TEST(FrameMessages, FlagsSayHowTheFrameWasClosedAndFused) {
  EXPECT_EQ(header_of({.is_timed_out = true}).flags, 0x01);
  EXPECT_EQ(header_of({.rule = vehicle::FusionRule::kBayes}).flags, 0x02);
  EXPECT_EQ(header_of({.is_timed_out = true, .rule = vehicle::FusionRule::kBayes}).flags, 0x03);
}

TEST(FrameMessages, TheEndHasTheRest) {
  FrameReport report{.opened_us = 33,
                     .ticks = {.fuse = 1, .mark = 2, .publish = 3},
                     .ticks_hz = 1000,
                     .vitals = {.stack_used_bytes = 8, .link_counter_count = 2}};
  report.vitals.link_counters = {11, 12};
  report.sensors[1].points = 99;
  report.unwatched = 5;
  report.vitals.temperature_dc = 612;
  report.blocked = 4;
  stream::FrameEnd end;
  set_frame_end(report, end);
  EXPECT_EQ(end.opened_us, 33U);
  EXPECT_EQ(end.ticks.publish, 3U);
  EXPECT_EQ(end.stopwatch_hz, 1000U);
  EXPECT_EQ(end.stack_used_bytes, 8U);
  EXPECT_EQ(end.link_counter_count, 2);
  EXPECT_EQ(end.link_counters[1], 12U);
  EXPECT_EQ(end.sensors[1].points, 99U);
  EXPECT_EQ(end.unwatched, 5U);
  EXPECT_EQ(end.temperature_dc, 612);
  EXPECT_EQ(end.blocked, 4U);
  EXPECT_EQ(end.tiles_sent + end.tiles_lost + end.grid_crc, 0U);
}

}  // namespace
}  // namespace iog::app
