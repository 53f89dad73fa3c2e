// What differs between Velodyne's units: each against its manual's tables, written here in
// microseconds and degrees, and against packets of real ones.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string_view>
#include <vector>

#include "fakes/from_hex.hpp"
#include "fakes/real_velodyne_packets.hpp"
#include "fakes/real_vls128_packet.hpp"
#include "fakes/velodyne_packet.hpp"
#include "lidar/formats.hpp"

namespace iog::lidar {
namespace {

using Packet = tests::VelodynePacket;

template <typename Decoder>
std::vector<ScanPoint> points_of(const std::vector<std::byte>& bytes,
                                 std::span<const LaserCorrection> corrections = {}) {
  Decoder packet;
  EXPECT_EQ(packet.decode(bytes, corrections), DecodeStatus::kOk);
  std::vector<ScanPoint> points;
  packet.for_each_point([&](const ScanPoint& point) { points.push_back(point); });
  return points;
}

template <typename Decoder>
DecodeStatus status_of(const std::vector<std::byte>& bytes) {
  return Decoder().decode(bytes);
}

// A packet of the unit whose head turns 2.4 degrees a block.
Packet turning(const Packet& unit) {
  Packet packet = unit;
  packet.first_azimuth = 10'000;
  packet.step = 240;
  return packet;
}

constexpr Packet kHdl32e{.product = 0x21};
constexpr Packet kPuckHires{.product = 0x24};
constexpr Packet kVlp32c{.product = 0x28};
constexpr Packet kHdl64e{.mode = 0x37, .product = 0x21, .blocks_of_azimuth = 2, .banks = 2};
constexpr Packet kVls128{.product = 0xA1, .banks = 4};

// How far a point of the first azimuth lies clockwise of 100 degrees, in 0.01 degrees.
double turned(const ScanPoint& point) { return 26'000.0 - point.azimuth_ticks; }

// HDL-32E User Manual, appendix on firing sequence: one laser each 1.152 us, the next sequence
// 46.08 us after this one.
TEST(VelodyneUnits, AnHdl32eFiresItsLasersOneAfterAnother) {
  const auto points = points_of<VelodyneHdl32e>(turning(kHdl32e).bytes());
  for (std::size_t laser = 0; laser < 32; ++laser) {
    EXPECT_EQ(points[laser].layer, laser);
    EXPECT_NEAR(turned(points[laser]), 240 * 1.152 * static_cast<double>(laser) / 46.08, 0.51);
    EXPECT_NEAR(turned(points[32 + laser]) - 240, turned(points[laser]), 1e-9);
  }
}

// docs/spec.md 1.2: a head that gains 0.2 degrees a block has gained k / 2 hundredths when laser k
// fires.
TEST(VelodyneUnits, ATieOfTheTurnGoesClockwise) {
  Packet packet = turning(kHdl32e);
  packet.step = 20;
  const auto points = points_of<VelodyneHdl32e>(packet.bytes());
  for (std::size_t laser = 0; laser < 32; ++laser) {
    EXPECT_EQ(turned(points[laser]), static_cast<double>((laser + 1) / 2));
  }
}

// The manual's table of elevations by firing order begins -30.67, -9.33, -29.33, -8.00 and ends
// -12.00, 9.33, -10.67, 10.67.
TEST(VelodyneUnits, AnHdl32eLooksFromFarBelowToALittleUp) {
  const auto& deg = VelodyneHdl32e::kElevationsDeg;
  EXPECT_NEAR(deg[0], -30.67, 0.005);
  EXPECT_NEAR(deg[1], -9.33, 0.005);
  EXPECT_NEAR(deg[2], -29.33, 0.005);
  EXPECT_NEAR(deg[3], -8.00, 0.005);
  EXPECT_NEAR(deg[28], -12.00, 0.005);
  EXPECT_NEAR(deg[29], 9.33, 0.005);
  EXPECT_NEAR(deg[30], -10.67, 0.005);
  EXPECT_NEAR(deg[31], 10.67, 0.005);
}

// VLP-32C User Manual, chapter 9: two lasers each 2.304 us, the next sequence 55.296 us after this
// one; laser 0 looks 1.4 degrees past the azimuth, 1 4.2 before it, 6 4.2 past it.
TEST(VelodyneUnits, AVlp32cFiresTwoLasersAtOnceToEitherSide) {
  const auto points = points_of<VelodyneVlp32c>(turning(kVlp32c).bytes());
  const auto expect_at = [&](std::size_t laser, double offset) {
    const double us = 2.304 * std::floor(static_cast<double>(laser) / 2);
    EXPECT_NEAR(turned(points[laser]), 240 * us / 55.296 + offset, 0.51) << laser;
  };
  expect_at(0, 140);
  expect_at(1, -420);
  expect_at(6, 420);
  expect_at(17, -420);
  expect_at(29, -140);
  expect_at(31, -140);
  EXPECT_DOUBLE_EQ(VelodyneVlp32c::kElevationsDeg[0], -25);
  EXPECT_DOUBLE_EQ(VelodyneVlp32c::kElevationsDeg[29], 15);
}

TEST(VelodyneUnits, AVlp32cCountsInFourMillimetres) {
  Packet packet = kVlp32c;
  packet.ranges[3][7] = 1'000;
  EXPECT_EQ(points_of<VelodyneVlp32c>(packet.bytes())[3 * 32 + 7].range_mm, 4'000U);
  packet.product = 0x21;
  EXPECT_EQ(points_of<VelodyneHdl32e>(packet.bytes())[3 * 32 + 7].range_mm, 2'000U);
}

// HDL-64E S2 and S3 manuals, tables of timing: eight groups of four lasers, 6.0 and 7.2 us apart;
// both banks at the same time.
TEST(VelodyneUnits, AnHdl64eFiresBothBanksTogether) {
  const auto check = [](const std::vector<ScanPoint>& points, double column_us, double group_us,
                        const std::array<double, 4>& in_group_us) {
    for (std::size_t laser = 0; laser < 64; ++laser) {
      EXPECT_EQ(points[laser].layer, laser);
      const double us = static_cast<double>(laser % 32 / 4) * group_us + in_group_us[laser % 4];
      EXPECT_NEAR(turned(points[laser]), 240 * us / column_us, 1.01) << laser;
      EXPECT_NEAR(turned(points[64 + laser]) - 240, turned(points[laser]), 1e-9);
    }
  };
  const auto bytes = turning(kHdl64e).bytes();
  check(points_of<VelodyneHdl64eS2>(bytes), 48.0, 6.0, {0, 1.26, 2.46, 3.66});
  check(points_of<VelodyneHdl64eS3>(bytes), 57.6, 7.2, {0, 1.3, 2.5, 3.7});
}

// With two returns an azimuth comes four times: strongest upper, lower, last upper, lower.
TEST(VelodyneUnits, AnHdl64eShowsItsModeByItsAzimuths) {
  Packet packet = kHdl64e;
  packet.blocks_of_azimuth = 4;
  packet.ranges[0][5] = 4'000;
  packet.ranges[2][5] = 3'000;
  packet.ranges[1][9] = 500;
  packet.ranges[3][9] = 500;
  const auto points = points_of<VelodyneHdl64eS3>(packet.bytes());
  EXPECT_EQ(points[5].range_mm, 6'000U);
  EXPECT_EQ(points[5].echo, 0);
  EXPECT_EQ(points[64 + 5].range_mm, 8'000U);
  EXPECT_EQ(points[64 + 5].echo, 1);
  EXPECT_EQ(points[64 + 5].layer, 5);
  EXPECT_EQ(points[32 + 9].layer, 41);
  EXPECT_EQ(points[32 + 9].range_mm, 1'000U);
  EXPECT_EQ(points[96 + 9].range_mm, 0U);
}

// VLP-16 User Manual, table 9-1: vertical angles of a Puck Hi-Res by laser id. When they fire it
// says of both units at once: 2.304 us apart, the second sequence after 55.296 us.
TEST(VelodyneUnits, APuckHiResIsAVlp16WithOtherAngles) {
  const std::array<double, 16> expected{-10.00, 0.67, -8.67, 2.00, -7.33, 3.33, -6.00, 4.67,
                                        -4.67,  6.00, -3.33, 7.33, -2.00, 8.67, -0.67, 10.00};
  for (std::size_t laser = 0; laser < 16; ++laser) {
    EXPECT_NEAR(VelodynePuckHires::kElevationsDeg[laser], expected[laser], 0.004) << laser;
  }
  Packet packet = turning(kPuckHires);
  packet.ranges[0][17] = 1'000;
  const auto points = points_of<VelodynePuckHires>(packet.bytes());
  for (std::size_t k = 0; k < 32; ++k) {
    EXPECT_EQ(points[k].layer, k % 16);
    const double us = 2.304 * static_cast<double>(k % 16) + (k < 16 ? 0 : 55.296);
    EXPECT_NEAR(turned(points[k]), 240 * us / 110.592, 0.51) << k;
  }
  EXPECT_EQ(points[17].range_mm, 2'000U);
}

// VLS-128 User Manual, chapter 9.4: a firing is 20 slots of 2.665 us; eight lasers fire in each of
// the first eight, one slot is a pause, eight fire in each of the next eight. Lasers look by turns
// 6.354, 4.548, 2.732 and 0.911 degrees past the azimuth and before it.
TEST(VelodyneUnits, AVls128FiresEightLasersAtOnce) {
  constexpr std::array<double, 8> kOffsets{635.4, 454.8,  273.2,  91.1,
                                           -91.1, -273.2, -454.8, -635.4};
  Packet packet = turning(kVls128);
  packet.ranges[7][31] = 1'000;
  const auto points = points_of<VelodyneVls128>(packet.bytes());
  for (std::size_t laser = 0; laser < 128; ++laser) {
    EXPECT_EQ(points[laser].layer, laser);
    const std::size_t group = laser / 8;
    const auto slot = static_cast<double>(group < 8 ? group : group + 1);
    EXPECT_NEAR(turned(points[laser]), 240 * slot / 20 + kOffsets[laser % 8], 1.01) << laser;
    EXPECT_NEAR(turned(points[128 + laser]) - 240, turned(points[laser]), 1e-9);
  }
  EXPECT_EQ(points[7 * 32 + 31].range_mm, 4'000U);
  EXPECT_DOUBLE_EQ(VelodyneVls128::kElevationsDeg[36], -25);
  EXPECT_DOUBLE_EQ(VelodyneVls128::kElevationsDeg[59], 15);
}

// Nebula knows each laser's elevation and offset, but does not turn the first three banks on until
// they fire. The head of this packet gains 0.19 degrees meanwhile.
TEST(VelodyneUnits, ARealVls128IsWhereAnotherDecoderPutsIt) {
  constexpr double kDegree = 3.14159265358979 / 180;
  const auto points = points_of<VelodyneVls128>(tests::from_hex(tests::kVls128));
  std::size_t next = 0;
  for (std::size_t laser = 0; laser < 128; ++laser) {
    const ScanPoint& point = points[laser];
    if (point.range_mm == 0) {
      continue;
    }
    ASSERT_LT(next, tests::kNebulaOfVls128.size());
    const tests::NebulaPoint& its = tests::kNebulaOfVls128[next++];
    const auto slot = static_cast<double>(laser / 8 + laser / 64);
    const double not_turned_deg = laser < 96 ? 0.19 * slot / 20 : 0;
    const double azimuth = (point.azimuth_ticks / 100.0 + not_turned_deg) * kDegree;
    const double elevation = VelodyneVls128::kElevationsDeg.at(laser) * kDegree;
    const double flat_mm = point.range_mm * std::cos(elevation);
    const double tolerance_mm = 1 + 2e-4 * point.range_mm;
    EXPECT_NEAR(flat_mm * std::cos(azimuth), its.x_mm, tolerance_mm) << laser;
    EXPECT_NEAR(flat_mm * std::sin(azimuth), its.y_mm, tolerance_mm) << laser;
    EXPECT_NEAR(point.range_mm * std::sin(elevation), its.z_mm, tolerance_mm) << laser;
  }
  EXPECT_EQ(next, tests::kNebulaOfVls128.size());
}

// No recording of that mode is known.
TEST(VelodyneUnits, TwoReturnsOfAVls128AreNotTaken) {
  Packet packet = kVls128;
  packet.mode = 0x39;
  EXPECT_EQ(status_of<VelodyneVls128>(packet.bytes()), DecodeStatus::kWrongType);
}

// How long a packet takes: 12 azimuths, 6 if there are two returns or two banks, 3 if both or
// if there are four banks.
TEST(VelodyneUnits, APacketLastsAsLongAsItsFirings) {
  const auto lasts_us = [](const auto decoder, const Packet& packet) {
    auto copy = decoder;
    EXPECT_EQ(copy.decode(packet.bytes()), DecodeStatus::kOk);
    return copy.info().sweep.end_us - copy.info().sweep.begin_us;
  };
  Packet dual32 = kHdl32e;
  dual32.mode = 0x39;
  Packet dual64 = kHdl64e;
  dual64.blocks_of_azimuth = 4;
  EXPECT_EQ(lasts_us(VelodyneHdl32e(), kHdl32e), 553U);
  EXPECT_EQ(lasts_us(VelodyneHdl32e(), dual32), 276U);
  EXPECT_EQ(lasts_us(VelodyneVlp32c(), kVlp32c), 664U);
  EXPECT_EQ(lasts_us(VelodyneHdl64eS2(), kHdl64e), 288U);
  EXPECT_EQ(lasts_us(VelodyneHdl64eS3(), kHdl64e), 346U);
  EXPECT_EQ(lasts_us(VelodyneHdl64eS3(), dual64), 173U);
  EXPECT_EQ(lasts_us(VelodyneVls128(), kVls128), 166U);
}

TEST(VelodyneUnits, ACalibratedLaserIsTurnedAndItsRangeMended) {
  std::vector<LaserCorrection> corrections(64);
  corrections[40] = {.azimuth_ticks = -533, .range_mm = 1'230};
  Packet packet = kHdl64e;
  packet.step = 0;
  packet.ranges[1][8] = 2'500;
  packet.ranges[1][9] = 2'500;
  const auto points = points_of<VelodyneHdl64eS3>(packet.bytes(), corrections);
  EXPECT_EQ(points[40].range_mm, 6'230U);
  EXPECT_EQ(points[40].azimuth_ticks, 36'000 - 533);
  EXPECT_EQ(points[41].range_mm, 5'000U);
  EXPECT_EQ(points[41].azimuth_ticks, 0);
  EXPECT_EQ(points[64 + 40].range_mm, 0U);  // no return stays none
  corrections[40].range_mm = -9'000;
  EXPECT_EQ(points_of<VelodyneHdl64eS3>(packet.bytes(), corrections)[40].range_mm, 1U);
}

// No unit is taken for another, where its packets say what they are.
TEST(VelodyneUnits, EachRefusesWhatSaysThatItIsOfAnother) {
  const auto hdl64e = kHdl64e.bytes();
  const auto vlp32c = kVlp32c.bytes();
  const auto vlp16 = Packet{}.bytes();
  EXPECT_EQ(status_of<VelodyneHdl32e>(vlp32c), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneHdl32e>(vlp16), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneHdl32e>(hdl64e), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneVlp16>(vlp32c), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneVlp16>(kPuckHires.bytes()), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodynePuckHires>(vlp16), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodynePuckHires>(Packet{.product = 0x21}.bytes()),
            DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneVlp32c>(vlp16), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneHdl64eS2>(vlp16), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneHdl64eS3>(vlp32c), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneHdl64eS3>(kVls128.bytes()), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneVls128>(hdl64e), DecodeStatus::kOtherUnit);
  EXPECT_EQ(status_of<VelodyneVls128>(vlp16), DecodeStatus::kOtherUnit);
}

// A flat ground is as far below the scanner as the beam that meets it goes down.
template <typename Decoder>
std::vector<double> heights_above_ground(std::string_view hex, double lowest_deg) {
  std::vector<double> heights;
  const auto points = points_of<Decoder>(tests::from_hex(hex));
  for (std::size_t i = 0; i < 32; ++i) {
    const double elevation_deg = Decoder::kElevationsDeg.at(points[i].layer);
    if (elevation_deg < lowest_deg && points[i].range_mm != 0) {
      heights.push_back(-std::sin(elevation_deg * 3.14159265358979 / 180) * points[i].range_mm /
                        1000);
    }
  }
  return heights;
}

double spread(const std::vector<double>& heights) {
  const auto [low, high] = std::ranges::minmax(heights);
  return high - low;
}

TEST(VelodyneUnits, TheRoadUnderARealHdl32eIsFlat) {
  const auto heights = heights_above_ground<VelodyneHdl32e>(tests::kHdl32eFirst, -20);
  ASSERT_EQ(heights.size(), 8U);
  EXPECT_LT(spread(heights), 0.1);
  EXPECT_NEAR(heights[0], 2.3, 0.1);
  // The same bytes as those of a VLP-16: its decoder takes them, and the road is a ramp.
  EXPECT_GT(spread(heights_above_ground<VelodyneVlp16>(tests::kHdl32eFirst, -8)), 0.5);
}

TEST(VelodyneUnits, TheRoadUnderARealVlp32cIsFlat) {
  const auto heights = heights_above_ground<VelodyneVlp32c>(tests::kVlp32c, -5);
  ASSERT_EQ(heights.size(), 7U);
  EXPECT_LT(spread(heights), 0.03);
}

}  // namespace
}  // namespace iog::lidar
