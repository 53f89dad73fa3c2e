#include "tools/fuse/scan_points.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "protection/protected_message.hpp"
#include "stream/message.hpp"
#include "tools/formats/lux/lux_scan.hpp"

namespace iog::tools {
namespace {

constexpr double kPi = 3.14159265358979323846;

// A packet of one point at that angle, in degrees to the left, of the layer at +0.4 degrees.
CapturedDatagram packet(std::uint16_t port, double angle_deg, double range_m) {
  LuxScan scan;
  scan.points.push_back({.layer = 2,
                         .angle_ticks = static_cast<std::int16_t>(std::lround(angle_deg * 32)),
                         .range_cm = static_cast<std::uint16_t>(std::lround(range_m * 100))});
  CapturedDatagram datagram;
  datagram.destination.port = port;
  datagram.payload = split_lux_scan(scan).front();
  return datagram;
}

// Of packets that a target takes one after the other.
std::vector<SeenPoint> points_of(const CatalogueEntry& car,
                                 const std::vector<CapturedDatagram>& packets) {
  OfflineTarget target(*car.vehicle, [](auto /*message*/) {});
  ScanPoints judged(car, target);
  std::vector<SeenPoint> points;
  for (const CapturedDatagram& each : packets) {
    static_cast<void>(judged.take(each, points));
  }
  return points;
}

// The mount's yaw and the point's angle add up; the rest is a right-angled triangle.
TEST(ScanPoints, LieWhereMountAndAngleSay) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const double flat_m = 20 * std::cos(0.4 * kPi / 180);
  for (const double angle_deg : {-40.0, 0.0, 25.0}) {
    const auto points = points_of(car, {packet(12002, angle_deg, 20)});  // front left, yaw 40
    ASSERT_EQ(points.size(), 1U);
    const double direction = (40 + angle_deg) * kPi / 180;
    EXPECT_NEAR(points[0].x_cm, 195 + 100 * flat_m * std::cos(direction), 0.51);
    EXPECT_NEAR(points[0].y_cm, 60 + 100 * flat_m * std::sin(direction), 0.51);
    EXPECT_EQ(points[0].fate, vehicle::Fate::kUsed);
  }
}

// So much over the unit as the layer rises on the way.
TEST(ScanPoints, AreAsHighAsTheBeam) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const std::vector<SeenPoint> points = points_of(car, {packet(12002, 0, 20)});
  ASSERT_EQ(points.size(), 1U);
  const double unit_m = car.sensors[sensor_of_port(car, 12002)].mount.z_m;
  EXPECT_NEAR(points[0].z_cm, 100 * (unit_m + 20 * std::sin(0.4 * kPi / 180)), 0.51);
}

TEST(ScanPoints, CarryTheirFate) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const std::vector<SeenPoint> points = points_of(
      car,
      {packet(12003, 0, 60), packet(12003, 0, 0.2), packet(12003, 0, 0)});  // no return: nowhere
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].fate, vehicle::Fate::kTooFar);
  EXPECT_EQ(points[1].fate, vehicle::Fate::kTooNear);
}

TEST(ScanPoints, WhatIsNoPacketOfASensorHasNone) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  CapturedDatagram cut = packet(12003, 0, 10);
  cut.payload.pop_back();
  EXPECT_TRUE(points_of(car, {packet(9999, 0, 10), cut}).empty());
}

// Over a drive, as many points of each outcome as the target counts in its frames.
TEST(ScanPoints, AreJudgedByTheTargetsGround) {
  const CatalogueEntry& car = find_vehicle("roof_vlp16");
  std::array<std::uint64_t, vehicle::kFateCount> counted{};
  OfflineTarget target(*car.vehicle, [&](std::span<const std::byte> message) {
    stream::Header header;
    std::span<const std::byte> body;
    const std::span content = message.subspan(protection::kProtectionBytes);
    ASSERT_EQ(stream::read_header(content, header, body), stream::ReadStatus::kOk);
    stream::FrameEnd end;
    if (header.type == stream::MessageType::kFrameEnd) {
      ASSERT_EQ(stream::read_frame_end(body, header.sensor_count, end), stream::ReadStatus::kOk);
      for (std::size_t fate = 0; fate < counted.size(); ++fate) {
        counted[fate] += end.fates[fate];
      }
    }
  });
  ScanPoints judged(car, target);
  std::array<std::uint64_t, vehicle::kFateCount> seen{};
  std::vector<SeenPoint> points;
  for (const CapturedDatagram& datagram : sample_drive(car, 1, 8)) {
    static_cast<void>(judged.take(datagram, points));
  }
  target.finish();
  for (const SeenPoint& point : points) {
    ++seen[static_cast<std::size_t>(point.fate)];
  }
  counted[static_cast<std::size_t>(vehicle::Fate::kNoReturn)] = 0;
  EXPECT_EQ(seen, counted);
  EXPECT_GT(seen[static_cast<std::size_t>(vehicle::Fate::kGround)], 10'000U);
}

}  // namespace
}  // namespace iog::tools
