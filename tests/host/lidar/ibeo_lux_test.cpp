#include "lidar/ibeo_lux.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/lux_message.hpp"

namespace iog::lidar {
namespace {

using tests::LuxMessage;
using tests::LuxPoint;

// The head of a real message: LUX device 1 of the recording two_lux_parking (PolySync transcoder,
// MIT), scan 42692; only its two length fields are changed, to those of three points.
constexpr std::array<std::uint8_t, 24 + 44> kRealHead{
    0xAF, 0xFE, 0xC0, 0xC2, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x4A, 0x00, 0x01,
    0x22, 0x02, 0xDA, 0xF4, 0x97, 0x29, 0xF8, 0xCD, 0x0F, 0xE9, 0xC4, 0xA6, 0x1B, 0x23,
    0x00, 0x00, 0xB2, 0x2A, 0xC2, 0x29, 0x2A, 0x97, 0xF4, 0xDA, 0x58, 0x56, 0x9A, 0x2C,
    0x2A, 0x97, 0xF4, 0xDA, 0x00, 0x2D, 0x40, 0x06, 0xC0, 0xF9, 0x03, 0x00, 0xC0, 0x03,
    0x00, 0x00, 0x00, 0x00, 0x34, 0x01, 0x1C, 0x00, 0x11, 0x00, 0x03, 0x00};

std::vector<ScanPoint> points_of(const IbeoLux& lux) {
  std::vector<ScanPoint> points;
  lux.for_each_point([&](const ScanPoint& point) { points.push_back(point); });
  return points;
}

DecodeStatus decode(const std::vector<std::byte>& bytes) {
  IbeoLux lux;
  return lux.decode(bytes);
}

TEST(IbeoLux, ReadsARealHead) {
  // Three points follow: layer 0, straight ahead, no range.
  std::vector<std::byte> bytes(kRealHead.size() + 30);
  std::ranges::transform(kRealHead, bytes.begin(),
                         [](std::uint8_t byte) { return std::byte{byte}; });
  IbeoLux lux;
  ASSERT_EQ(lux.decode(bytes), DecodeStatus::kOk);
  EXPECT_EQ(lux.info().scan_number, 42'692U);
  EXPECT_EQ(lux.info().point_count, 3U);
  EXPECT_EQ(lux.info().sector.first_ticks, 11520 - 1600);
  EXPECT_EQ(lux.info().sector.width_ticks, 3200);
  // 2016-05-28, 22:16:10 UTC: NTP DAF4972A.29C22AB2 to DAF4972A.2C9A5658.
  EXPECT_EQ(lux.info().sweep.begin_us, 1'464'473'770'163'119U);
  EXPECT_EQ(lux.info().sweep.end_us, 1'464'473'770'174'230U);
  EXPECT_TRUE(lux.info().sweep.turns_right);
}

// NTP counts from 1900-01-01: 1970 is 2,208,988,800 s (RFC 868), and 2^32 s, in 2036, are 0 again.
TEST(IbeoLux, TimesAreFrom1970To2106) {
  const auto begin_of = [](std::uint64_t ntp) {
    IbeoLux lux;
    const std::vector<std::byte> bytes = LuxMessage{.start_ntp = ntp}.bytes();
    EXPECT_EQ(lux.decode(bytes), DecodeStatus::kOk);
    return lux.info().sweep.begin_us;
  };
  constexpr std::uint64_t kUnixEpoch = 2'208'988'800U;
  constexpr std::uint64_t kSecondUs = 1'000'000;
  EXPECT_EQ(begin_of(kUnixEpoch << 32), 0U);
  EXPECT_EQ(begin_of(0), ((std::uint64_t{1} << 32) - kUnixEpoch) * kSecondUs);
  EXPECT_EQ(begin_of((kUnixEpoch - 1) << 32), 0xFFFF'FFFFU * kSecondUs);
  // Every microsecond of a second comes back, however its fraction was rounded.
  for (std::uint64_t us = 0; us < kSecondUs; us += 997) {
    const std::uint64_t fraction = (us << 32) / kSecondUs;
    ASSERT_EQ(begin_of((kUnixEpoch + 7) << 32 | fraction), 7 * kSecondUs + us);
  }
}

// The order of a message's start and end angle says how the mirror turns.
TEST(IbeoLux, TheMirrorTurnsFromStartToEnd) {
  IbeoLux lux;
  const std::vector<std::byte> bytes = LuxMessage{.start_ticks = -100, .end_ticks = 200}.bytes();
  ASSERT_EQ(lux.decode(bytes), DecodeStatus::kOk);
  EXPECT_FALSE(lux.info().sweep.turns_right);
}

TEST(IbeoLux, TurnsTicksAndCentimetresIntoAPoint) {
  const LuxMessage message{
      .points = {{.layer = 2, .angle_ticks = -32, .range_cm = 1234},
                 {.layer = 3, .echo = 2, .flags = 0x54, .angle_ticks = 1600, .range_cm = 65535},
                 {.flags = 0x02},
                 {.flags = 0x08}}};
  IbeoLux lux;
  const std::vector<std::byte> bytes = message.bytes();
  ASSERT_EQ(lux.decode(bytes), DecodeStatus::kOk);
  const std::vector<ScanPoint> points = points_of(lux);
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[0].range_mm, 12'340U);
  EXPECT_EQ(points[0].azimuth_ticks, 11520 - 32);
  EXPECT_EQ(points[0].layer, 2);
  EXPECT_EQ(points[0].echo, 0);
  EXPECT_FALSE(points[0].is_ground || points[0].is_dirt || points[0].is_rain);
  EXPECT_EQ(points[1].range_mm, 655'350U);
  EXPECT_EQ(points[1].azimuth_ticks, 1600);
  EXPECT_EQ(points[1].echo, 2);
  EXPECT_TRUE(points[1].is_ground);  // 0x04; the reserved 0x50 is ignored
  EXPECT_TRUE(points[2].is_rain);
  EXPECT_TRUE(points[3].is_dirt);
}

TEST(IbeoLux, RefusesWhatIsNotItsFormat) {
  const LuxMessage good{.points = {{.range_cm = 100}}};
  auto bytes = good.bytes();
  bytes.at(0) = std::byte{0};
  EXPECT_EQ(decode(bytes), DecodeStatus::kWrongType);
  bytes = good.bytes();
  bytes.at(15) = std::byte{0x05};  // 0x2205
  EXPECT_EQ(decode(bytes), DecodeStatus::kWrongType);
  bytes = good.bytes();
  bytes.at(24 + 23) = std::byte{0};  // ticks per rotation
  EXPECT_EQ(decode(bytes), DecodeStatus::kWrongAngle);
  EXPECT_EQ(decode(LuxMessage{.start_ticks = 5761, .points = {}}.bytes()),
            DecodeStatus::kWrongAngle);
}

TEST(IbeoLux, RefusesImpossiblePoints) {
  EXPECT_EQ(decode(LuxMessage{.points = {{.layer = 4}}}.bytes()), DecodeStatus::kWrongPoint);
  EXPECT_EQ(decode(LuxMessage{.points = {{.echo = 3}}}.bytes()), DecodeStatus::kWrongPoint);
  EXPECT_EQ(decode(LuxMessage{.points = {{.angle_ticks = 1601}}}.bytes()),
            DecodeStatus::kWrongPoint);
  EXPECT_EQ(decode(LuxMessage{.points = {{.angle_ticks = -1601}}}.bytes()),
            DecodeStatus::kWrongPoint);
  EXPECT_EQ(decode(LuxMessage{.points = {{.angle_ticks = -1600}}}.bytes()), DecodeStatus::kOk);
}

TEST(IbeoLux, BelievesNoLengthButItsOwn) {
  const auto bytes = LuxMessage{.points = std::vector<LuxPoint>(5)}.bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(decode({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}),
              DecodeStatus::kWrongLength);
  }
  auto longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_EQ(decode(longer), DecodeStatus::kWrongLength);
  auto boastful = bytes;
  boastful.at(24 + 28) = std::byte{6};  // one point more than there is
  EXPECT_EQ(decode(boastful), DecodeStatus::kWrongLength);
}

TEST(IbeoLux, KnowsAPacketByItsFingerprint) {
  LuxMessage message{.points = {{.range_cm = 100}, {.range_cm = 200}}};
  IbeoLux one;
  IbeoLux same;
  IbeoLux other;
  ASSERT_EQ(one.decode(message.bytes()), DecodeStatus::kOk);
  ASSERT_EQ(same.decode(message.bytes()), DecodeStatus::kOk);
  message.points[1].range_cm = 201;
  ASSERT_EQ(other.decode(message.bytes()), DecodeStatus::kOk);
  EXPECT_EQ(one.info().fingerprint, same.info().fingerprint);
  EXPECT_NE(one.info().fingerprint, other.info().fingerprint);
}

// A lie about the number of points is not so many points dropped.
TEST(IbeoLux, CountsNoPointsThatAreNotThere) {
  auto boastful = LuxMessage{.points = std::vector<LuxPoint>(5)}.bytes();
  boastful.at(24 + 29) = std::byte{0xFF};
  IbeoLux lux;
  ASSERT_EQ(lux.decode(boastful), DecodeStatus::kWrongLength);
  EXPECT_EQ(lux.info().point_count, 0U);
}

}  // namespace
}  // namespace iog::lidar
