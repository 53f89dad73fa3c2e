// From a datagram to a packet of the frame: one decode, and a value that can be asked about again.
#include "intake/intake.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/from_hex.hpp"
#include "fakes/hesai_packet.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/ouster_packet.hpp"
#include "fakes/real_velodyne_packets.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/velodyne_packet.hpp"

namespace iog::intake {
namespace {

using tests::LuxMessage;
using tests::ThreeLux;
using Outcome = Intake::Outcome;

constexpr std::uint32_t kReplayer = 0x0A000202;

std::vector<std::byte> scan(int number, int points = 3) {
  LuxMessage message{.scan_number = number, .points = {}};
  message.points.assign(static_cast<std::size_t>(points), {.angle_ticks = 5, .range_cm = 1000});
  return message.bytes();
}

std::uint32_t drops(const Intake& intake, PacketDrop cause) {
  return intake.packet_drops()[static_cast<std::size_t>(cause)];
}

std::vector<lidar::ScanPoint> points_of(const Packet& packet) {
  std::vector<lidar::ScanPoint> points;
  packet.for_each_point([&](const lidar::ScanPoint& point) { points.push_back(point); });
  return points;
}

TEST(Packet, IsDecodedByItsFormat) {
  const std::vector<std::byte> lux_bytes =
      LuxMessage{.scan_number = 7, .points = {{.layer = 2, .angle_ticks = 9, .range_cm = 1234}}}
          .bytes();
  const Packet lux = Packet::decode(lidar::kFormat<lidar::IbeoLux>, lux_bytes);
  ASSERT_TRUE(lux.is_sound());
  EXPECT_EQ(lux.info().scan_number, 7U);
  ASSERT_EQ(points_of(lux).size(), 1U);
  EXPECT_EQ(points_of(lux)[0].range_mm, 12'340U);

  tests::VelodynePacket turn;
  turn.ranges[0][1] = 5000;  // 2 mm each
  const std::vector<std::byte> vlp16_bytes = turn.bytes();
  const Packet vlp16 = Packet::decode(lidar::kFormat<lidar::VelodyneVlp16>, vlp16_bytes);
  ASSERT_TRUE(vlp16.is_sound());
  ASSERT_EQ(points_of(vlp16).size(), 384U);
  EXPECT_EQ(points_of(vlp16)[1].range_mm, 10'000U);

  EXPECT_EQ(Packet::decode(lidar::kFormat<lidar::VelodyneVlp16>, lux_bytes).status(),
            lidar::DecodeStatus::kWrongLength);
  EXPECT_EQ(Packet::decode(lidar::kFormat<lidar::IbeoLux>, vlp16_bytes).status(),
            lidar::DecodeStatus::kWrongType);
}

// A packet of every kind of decoder is read from a copy of its bytes, whatever becomes of them.
TEST(Packet, IsReadFromACopyOfItsBytes) {
  const auto expect_moved = [](lidar::Format format, std::vector<std::byte> bytes,
                               const lidar::Unit& unit = {}) {
    Packet packet = Packet::decode(format, bytes, unit);
    ASSERT_TRUE(packet.is_sound()) << lidar::name_of(format);
    const std::vector<lidar::ScanPoint> points = points_of(packet);
    ASSERT_FALSE(points.empty());
    const std::vector<std::byte> copy = bytes;
    packet.move_to(copy);
    std::ranges::fill(bytes, std::byte{0xA5});
    const std::vector<lidar::ScanPoint> moved = points_of(packet);
    ASSERT_EQ(moved.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(moved[i].range_mm, points[i].range_mm) << lidar::name_of(format) << " " << i;
      ASSERT_EQ(moved[i].azimuth_ticks, points[i].azimuth_ticks);
      ASSERT_EQ(moved[i].layer, points[i].layer);
    }
  };
  const std::vector<std::byte> lux =
      LuxMessage{.points = {{.layer = 2, .angle_ticks = 9, .range_cm = 1234},
                            {.layer = 3, .angle_ticks = 8, .range_cm = 555}}}
          .bytes();
  expect_moved(lidar::kFormat<lidar::IbeoLux>, lux);
  expect_moved(lidar::kFormat<lidar::IbeoLux8>, lux);
  tests::VelodynePacket turn;
  turn.ranges[3][7] = 5000;
  expect_moved(lidar::kFormat<lidar::VelodyneVlp16>, turn.bytes());
  tests::HesaiPacket blocks;
  blocks.ranges[2][5] = 5000;
  expect_moved(lidar::kFormat<lidar::HesaiPandar64>, blocks.bytes());
  tests::OusterPacket columns;
  columns.ranges[9][3] = 5000;
  const std::vector<lidar::LaserCorrection> rows(64);
  expect_moved(lidar::kFormat<lidar::OusterLegacy>, columns.bytes(),
               {.corrections = rows, .columns_per_turn = 1024, .column_ns = 97'656});
}

TEST(Intake, ThePortSaysWhoseThePacketIsAndTheSourceWhetherItMay) {
  Intake intake(ThreeLux::kVehicle.sensors, kReplayer);
  const auto bytes = scan(1);
  for (std::uint16_t port = 100; port <= 102; ++port) {
    const auto replayed = intake.receive({kReplayer, port, bytes});
    const auto own = intake.receive({0x0A000200U + port, port, bytes});
    ASSERT_TRUE(replayed && own);
    EXPECT_EQ(replayed->sensor, port - 100U);
    EXPECT_EQ(own->sensor, port - 100U);
  }
  EXPECT_FALSE(intake.receive({0x0A000264, 101, bytes}));  // another sensor's address
  EXPECT_FALSE(intake.receive({kReplayer, 103, bytes}));
  EXPECT_EQ(drops(intake, PacketDrop::kStranger), 2U);
}

// The packet is the same value before and after the frame was closed.
TEST(Intake, APacketOfTheNextFrameIsClassifiedAgain) {
  Intake intake(ThreeLux::kVehicle.sensors, kReplayer);
  const auto first_bytes = scan(1);
  const auto second_bytes = scan(2);
  const auto first = intake.receive({kReplayer, 100, first_bytes});
  const auto second = intake.receive({kReplayer, 100, second_bytes});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(intake.classify(*first), Outcome::kThisFrame);
  intake.accept(*first);
  EXPECT_EQ(intake.classify(*second), Outcome::kNextFrame);
  EXPECT_EQ(intake.packets_accepted(), 1U);
  intake.start_frame();
  EXPECT_EQ(intake.packets_accepted(), 0U);
  EXPECT_EQ(intake.classify(*second), Outcome::kThisFrame);
  intake.accept(*second);
  EXPECT_EQ(intake.report_of(0).scan_number, 2U);
  EXPECT_EQ(intake.report_of(0).state, SensorState::kComplete);
  EXPECT_EQ(intake.report_of(1).state, SensorState::kNeverSeen);
  EXPECT_EQ(intake.packets_dropped(), 0U);
}

TEST(Intake, WhatIsDroppedIsCountedWithItsPoints) {
  Intake intake(ThreeLux::kVehicle.sensors, kReplayer);
  auto wrong_point = scan(1, 5);
  wrong_point[68] = std::byte{0x0F};  // layer 15
  EXPECT_FALSE(intake.receive({kReplayer, 100, wrong_point}));
  EXPECT_EQ(drops(intake, PacketDrop::kWrongPoint), 1U);
  EXPECT_EQ(intake.points_dropped(vehicle::Fate::kMalformed), 5U);

  const auto bytes = scan(1, 4);
  const auto packet = intake.receive({kReplayer, 100, bytes});
  ASSERT_TRUE(packet);
  const auto flood_bytes = scan(1, 2413);  // 4 layers of 201 directions have three echoes each
  const auto flood = intake.receive({kReplayer, 101, flood_bytes});
  ASSERT_TRUE(flood);
  EXPECT_EQ(intake.classify(*flood), Outcome::kDropped);
  EXPECT_EQ(drops(intake, PacketDrop::kOverBudget), 1U);
  EXPECT_EQ(intake.points_dropped(vehicle::Fate::kMalformed), 5U + 2413U);

  intake.accept(*packet);
  EXPECT_EQ(intake.classify(*packet), Outcome::kDropped);  // a duplicate
  const auto late_bytes = scan(0, 7);
  const auto late = intake.receive({kReplayer, 100, late_bytes});
  ASSERT_TRUE(late);
  EXPECT_EQ(intake.classify(*late), Outcome::kDropped);
  EXPECT_EQ(intake.points_dropped(vehicle::Fate::kStale), 4U + 7U);
  EXPECT_EQ(drops(intake, PacketDrop::kDuplicate), 1U);
  EXPECT_EQ(drops(intake, PacketDrop::kLate), 1U);

  intake.start_frame();
  EXPECT_EQ(intake.points_dropped(vehicle::Fate::kStale), 0U);
  EXPECT_EQ(intake.points_dropped(vehicle::Fate::kMalformed), 0U);
  EXPECT_EQ(intake.packets_dropped(), 4U);
}

// Packets of a real HDL-32E, which have the product byte of a VLP-16 with old firmware: to that
// sensor the first is in doubt, and the second another unit's. To a sensor of their own kind only
// the doubt is left.
TEST(Intake, AnotherUnitsPacketsAreRefused) {
  const auto first = tests::from_hex(tests::kHdl32eFirst);
  const auto second = tests::from_hex(tests::kHdl32eSecond);
  for (const lidar::Format format :
       {lidar::kFormat<lidar::VelodyneVlp16>, lidar::kFormat<lidar::VelodyneHdl32e>}) {
    vehicle::Sensor sensor = ThreeLux::kVehicle.sensors[0];
    sensor.format = format;
    Intake intake(std::span(&sensor, 1), kReplayer);
    EXPECT_FALSE(intake.receive({kReplayer, 100, first}));
    const bool is_own = format == lidar::kFormat<lidar::VelodyneHdl32e>;
    EXPECT_EQ(intake.receive({kReplayer, 100, second}).has_value(), is_own);
    EXPECT_EQ(drops(intake, PacketDrop::kOtherUnit), is_own ? 1U : 2U);
    EXPECT_EQ(intake.points_dropped(vehicle::Fate::kMalformed), is_own ? 384U : 768U);
  }
}

}  // namespace
}  // namespace iog::intake
