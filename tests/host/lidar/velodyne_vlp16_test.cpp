#include "lidar/velodyne_vlp16.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/velodyne_packet.hpp"

namespace iog::lidar {
namespace {

using Packet = tests::VelodynePacket;

std::vector<ScanPoint> points_of(const std::vector<std::byte>& bytes) {
  VelodyneVlp16 packet;
  EXPECT_EQ(packet.decode(bytes), DecodeStatus::kOk);
  std::vector<ScanPoint> points;
  packet.for_each_point([&](const ScanPoint& point) { points.push_back(point); });
  return points;
}

DecodeStatus decode(const std::vector<std::byte>& bytes) {
  VelodyneVlp16 packet;
  return packet.decode(bytes);
}

TEST(VelodyneVlp16, TurnsUnitsIntoPoints) {
  Packet packet{.first_azimuth = 9000};
  packet.ranges[0][0] = 5000;
  packet.ranges[11][31] = 1;
  const auto points = points_of(packet.bytes());
  ASSERT_EQ(points.size(), 384U);
  EXPECT_EQ(points[0].range_mm, 10'000U);
  EXPECT_EQ(points[0].layer, 0);
  // 90 degrees clockwise from forward is to the right: 270 degrees counter-clockwise.
  EXPECT_EQ(points[0].azimuth_ticks, 27'000);
  EXPECT_EQ(points[383].range_mm, 2U);
  EXPECT_EQ(points[383].layer, 15);
}

// User manual, section 9.5: laser j of firing s fires 55.296 s + 2.304 j us after the block's
// azimuth was taken, and a block lasts 110.592 us.
TEST(VelodyneVlp16, TheHeadTurnsWhileTheLasersFire) {
  const auto points = points_of(Packet{.first_azimuth = 100, .step = 240}.bytes());
  for (std::size_t channel = 0; channel < 32; ++channel) {
    const std::size_t firing = channel / 16;
    const std::size_t laser = channel % 16;
    const double us = 55.296 * static_cast<double>(firing) + 2.304 * static_cast<double>(laser);
    const double clockwise = 100 + 240 * us / 110.592;
    EXPECT_NEAR(36'000 - points[channel].azimuth_ticks, clockwise, 0.51) << channel;
  }
}

// User manual, section 9.3: the time is that of the first firing. Twelve blocks last 1327.104 us,
// six pairs of one azimuth half of it.
TEST(VelodyneVlp16, ItsTimeIsThatOfItsFirstFiring) {
  for (const bool is_dual : {false, true}) {
    const auto bytes = Packet{.mode = is_dual ? 0x39 : 0x37, .time_us = 3'599'999'000}.bytes();
    VelodyneVlp16 packet;
    ASSERT_EQ(packet.decode(bytes), DecodeStatus::kOk);
    EXPECT_EQ(packet.info().sweep.begin_us, 3'599'999'000U);
    EXPECT_EQ(packet.info().sweep.end_us, 3'599'999'000U + (is_dual ? 664U : 1'327U));
    EXPECT_TRUE(packet.info().sweep.turns_right);
  }
}

TEST(VelodyneVlp16, SweepsClockwiseSoItsSectorEndsWhereItBegan) {
  VelodyneVlp16 packet;
  ASSERT_EQ(packet.decode(Packet{.first_azimuth = 35'900, .step = 40}.bytes()), DecodeStatus::kOk);
  // From 359.00 to 363.80 degrees clockwise, and the seam.
  EXPECT_EQ(packet.info().sector.width_ticks, 480 + VelodyneVlp16::kSeamTicks);
  EXPECT_EQ(packet.info().sector.first_ticks, 36'000 - 380 - VelodyneVlp16::kSeamTicks);
}

TEST(VelodyneVlp16, AzimuthsOf36000MeanZero) {
  const auto points = points_of(Packet{.first_azimuth = 35'960, .step = 40}.bytes());
  EXPECT_EQ(points[32].azimuth_ticks, 0);
}

// Dual return: the nearer of a pair is the first echo, whichever block it stands in; a beam with
// one return is not seen twice.
TEST(VelodyneVlp16, DualReturnsAreEchoesOfOneBeam) {
  Packet packet{.mode = 0x39};
  packet.ranges[0][0] = 3000;  // last
  packet.ranges[1][0] = 2000;  // strongest
  packet.ranges[0][1] = 1500;
  packet.ranges[1][1] = 1500;
  packet.ranges[0][2] = 700;
  packet.ranges[1][2] = 0;
  const auto points = points_of(packet.bytes());
  const auto at = [&](std::size_t block, std::size_t channel) {
    return points[block * 32 + channel];
  };
  EXPECT_EQ(at(0, 0).range_mm, 4'000U);
  EXPECT_EQ(at(0, 0).echo, 0);
  EXPECT_EQ(at(1, 0).range_mm, 6'000U);
  EXPECT_EQ(at(1, 0).echo, 1);
  EXPECT_EQ(at(0, 1).range_mm, 3'000U);
  EXPECT_EQ(at(1, 1).range_mm, 0U);
  EXPECT_EQ(at(0, 2).range_mm, 1'400U);
  EXPECT_EQ(at(1, 2).range_mm, 0U);
  EXPECT_EQ(at(0, 0).azimuth_ticks, at(1, 0).azimuth_ticks);
}

TEST(VelodyneVlp16, RefusesWhatIsNotItsFormat) {
  const auto good = Packet{}.bytes();
  EXPECT_EQ(decode(good), DecodeStatus::kOk);
  for (const std::size_t size : {0U, 42U, 1205U, 1207U, 1212U}) {
    auto bytes = good;
    bytes.resize(size);
    EXPECT_EQ(decode(bytes), DecodeStatus::kWrongLength);
  }
  EXPECT_EQ(decode(Packet{.mode = 0x36}.bytes()), DecodeStatus::kWrongType);
  EXPECT_EQ(decode(Packet{.product = 0x28}.bytes()), DecodeStatus::kOtherUnit);
  EXPECT_EQ(decode(Packet{.product = 0x21}.bytes()), DecodeStatus::kOk);
  auto bytes = good;
  bytes.at(500) = std::byte{0};  // the flag of block 5
  EXPECT_EQ(decode(bytes), DecodeStatus::kWrongType);
  bytes = good;
  bytes.at(303) = std::byte{0xFF};  // azimuth of block 3
  EXPECT_EQ(decode(bytes), DecodeStatus::kWrongAngle);
  EXPECT_EQ(decode(Packet{.step = 301}.bytes()), DecodeStatus::kWrongAngle);
}

}  // namespace
}  // namespace iog::lidar
