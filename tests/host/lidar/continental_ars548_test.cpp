// Detection lists of a Continental ARS548: a real one against another decoder, and its rules.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "fakes/ars548_list.hpp"
#include "fakes/real_ars548_list.hpp"
#include "lidar/decoded.hpp"

namespace iog::lidar {
namespace {

using tests::Ars548Detection;
using tests::Ars548List;

constexpr double kPi = 3.14159265358979;
constexpr float kDegree = static_cast<float>(kPi / 180);

Decoded decoded_list(std::span<const std::byte> bytes) {
  return {bytes, kFormat<ContinentalArs548>};
}

ScanPoint point_of(const Ars548Detection& detection) {
  const auto bytes = Ars548List{.detections = {detection}}.bytes();
  const Decoded decoded = decoded_list(bytes);
  EXPECT_EQ(decoded.status, DecodeStatus::kOk);
  return decoded.points.empty() ? ScanPoint{} : decoded.points[0];
}

DecodeStatus status_of(const Ars548Detection& detection) {
  return decoded_list(Ars548List{.detections = {detection}}.bytes()).status;
}

int signed_ticks(const ScanPoint& point) {
  return point.azimuth_ticks > 5760 ? point.azimuth_ticks - 11520 : point.azimuth_ticks;
}

// Nebula prints six digits: a millimetre of range at most.
TEST(ContinentalArs548, ARealListIsThatOfAnotherDecoder) {
  const auto bytes = tests::real_ars548_list();
  const Decoded decoded = decoded_list(bytes);
  ASSERT_EQ(decoded.status, DecodeStatus::kOk);
  ASSERT_EQ(decoded.points.size(), tests::kNebulaOfArs548.size());
  EXPECT_EQ(decoded.info.point_count, tests::kNebulaOfArs548.size());
  for (std::size_t i = 0; i < decoded.points.size(); ++i) {
    const tests::NebulaDetection& theirs = tests::kNebulaOfArs548.at(i);
    const ScanPoint& ours = decoded.points[i];
    EXPECT_NEAR(ours.range_mm, theirs.range * 1000, 1.01) << i;
    EXPECT_NEAR(signed_ticks(ours) / 32.0 * kPi / 180, theirs.azimuth, kPi / 180 / 64 + 1e-6) << i;
    const double size = std::max(0.0, std::abs(theirs.elevation) - theirs.elevation_std);
    const double elevation_deg = std::copysign(size, theirs.elevation) * 180 / kPi;
    EXPECT_EQ(ours.layer, std::floor(elevation_deg + 0.5) + 30) << i;
    EXPECT_EQ(ours.is_rain, theirs.classification == 3) << i;  // high enough to drive under it
    EXPECT_EQ(ours.echo, 0);
    EXPECT_FALSE(ours.is_ground || ours.is_dirt);
  }
}

// Its stamp as nebula reads it: 1708578203 s and 955760000 ns.
TEST(ContinentalArs548, AListIsMeasuredAtItsStamp) {
  const auto bytes = tests::real_ars548_list();
  const Decoded decoded = decoded_list(bytes);
  const PacketInfo& info = decoded.info;
  EXPECT_EQ(info.sweep.begin_us, 1'708'578'203'955'760U);
  EXPECT_EQ(info.sweep.end_us, info.sweep.begin_us);
  EXPECT_TRUE(info.sweep.is_of_packet);
  EXPECT_EQ(info.sector.first_ticks, 11520 - 1920);
  EXPECT_EQ(info.sector.width_ticks, 3840);
}

// Its cycle is 50 ms or more.
TEST(ContinentalArs548, ListsOfTwoCyclesAreTwoScans) {
  const auto first = Ars548List{.seconds = 7, .nanoseconds = 10'000'000}.bytes();
  const auto second = Ars548List{.seconds = 7, .nanoseconds = 60'000'000}.bytes();
  const Decoded one = decoded_list(first);
  const Decoded other = decoded_list(second);
  EXPECT_LT(one.info.scan_number, other.info.scan_number);
  EXPECT_NE(one.info.fingerprint, other.info.fingerprint);
  EXPECT_EQ(decoded_list(first).info.fingerprint, one.info.fingerprint);
}

// Two of the unit's other messages as tier4/nebula has them, and lists cut short.
TEST(ContinentalArs548, OtherMessagesAreOfAnotherType) {
  auto bytes = Ars548List{.method = 329}.bytes();
  bytes.resize(9401);
  EXPECT_EQ(decoded_list(bytes).status, DecodeStatus::kWrongType);
  bytes = Ars548List{.method = 380}.bytes();
  bytes.resize(84);
  EXPECT_EQ(decoded_list(bytes).status, DecodeStatus::kWrongType);
  bytes = Ars548List{}.bytes();
  EXPECT_EQ(decoded_list(bytes).status, DecodeStatus::kOk);
  bytes.pop_back();
  EXPECT_EQ(decoded_list(bytes).status, DecodeStatus::kWrongLength);
  bytes.push_back({});
  bytes[7] = std::byte{1};
  EXPECT_EQ(decoded_list(bytes).status, DecodeStatus::kWrongLength);
  EXPECT_EQ(decoded_list({}).status, DecodeStatus::kWrongLength);
}

TEST(ContinentalArs548, AListHas800DetectionsAtMost) {
  auto bytes = Ars548List{.detections = std::vector<Ars548Detection>(800)}.bytes();
  EXPECT_EQ(decoded_list(bytes).points.size(), 800U);
  const std::size_t count_at = bytes.size() - 35 + 8;
  bytes[count_at + 3] = std::byte{0x21};  // 801
  EXPECT_EQ(decoded_list(bytes).status, DecodeStatus::kWrongPoint);
  bytes[count_at] = std::byte{0xFF};
  EXPECT_EQ(decoded_list(bytes).status, DecodeStatus::kWrongPoint);
}

TEST(ContinentalArs548, WhatTheUnitDoesNotCallATargetIsDropped) {
  EXPECT_FALSE(point_of({}).is_rain);
  for (const int what : {0, 2, 4, 255}) {
    const ScanPoint point = point_of({.classification = static_cast<std::uint8_t>(what)});
    EXPECT_FALSE(point.is_rain);
    EXPECT_EQ(point.is_ground, what == 2);
  }
  EXPECT_TRUE(point_of({.classification = 1}).is_rain);  // noise
  EXPECT_TRUE(point_of({.classification = 3}).is_rain);  // traversable under
  EXPECT_TRUE(point_of({.existence = 49}).is_rain);
  EXPECT_FALSE(point_of({.existence = 50}).is_rain);
  EXPECT_FALSE(point_of({.azimuth = 60 * kDegree}).is_rain);
  EXPECT_TRUE(point_of({.azimuth = 60.1F * kDegree}).is_rain);
  EXPECT_TRUE(point_of({.azimuth = -60.1F * kDegree}).is_rain);
  EXPECT_FALSE(point_of({.elevation = 30 * kDegree}).is_rain);
  EXPECT_TRUE(point_of({.elevation = -31 * kDegree}).is_rain);
}

// Judged by the angle of the wire, not by the tick or the layer that it is rounded to: 60.01
// degrees have the tick of 60, 30.4 the layer of 30.
TEST(ContinentalArs548, BeyondTheFieldOfViewIsJudgedBeforeRounding) {
  for (const float side : {kDegree, -kDegree}) {
    EXPECT_FALSE(point_of({.azimuth = 60 * side}).is_rain);
    EXPECT_TRUE(point_of({.azimuth = 60.01F * side}).is_rain);
    EXPECT_FALSE(point_of({.elevation = 30 * side}).is_rain);
    EXPECT_TRUE(point_of({.elevation = 30.01F * side}).is_rain);
    EXPECT_TRUE(point_of({.elevation = 30.4F * side}).is_rain);
    // Of the elevation as near to the horizon as it may be.
    EXPECT_FALSE(point_of({.elevation = 34 * side, .elevation_std = 4 * kDegree}).is_rain);
    EXPECT_TRUE(point_of({.elevation = 34.4F * side, .elevation_std = 4 * kDegree}).is_rain);
  }
}

// An elevation whose deviation is not valid has none.
// Flag 0x20 is of the deviation alone: the drivers name it INVALID_ELEVATION_STD (ars548_ros) and
// invalid_elevation_std (nebula), apart from 0x10, and both hand the detection out.
TEST(ContinentalArs548, AnElevationIsAsNearToTheHorizonAsItMayBe) {
  const auto layer_of = [](float elevation_deg, float std_deg, std::uint8_t invalid = 0) {
    return point_of({.elevation = elevation_deg * kDegree,
                     .elevation_std = std_deg * kDegree,
                     .invalid_flags = invalid})
               .layer -
           30;
  };
  EXPECT_EQ(layer_of(10, 4), 6);
  EXPECT_EQ(layer_of(-10, 4), -6);
  EXPECT_EQ(layer_of(3, 4), 0);
  EXPECT_EQ(layer_of(-3, 4), 0);
  EXPECT_EQ(layer_of(7.6F, 0), 8);
  EXPECT_EQ(layer_of(-7.6F, 0), -8);
  EXPECT_EQ(layer_of(10, 4, 0x20), 10);
  for (const int deviation : {0x02, 0x08, 0x20, 0x80}) {
    EXPECT_FALSE(point_of({.invalid_flags = static_cast<std::uint8_t>(deviation)}).is_rain);
    EXPECT_EQ(point_of({.invalid_flags = static_cast<std::uint8_t>(deviation)}).range_mm, 10'000U);
  }
}

// Of what is invalid nothing is looked at.
TEST(ContinentalArs548, InvalidDetectionsHaveNoRange) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const int flag : {0x01, 0x04, 0x10}) {
    const ScanPoint point = point_of({.azimuth = nan,
                                      .elevation = nan,
                                      .range = nan,
                                      .invalid_flags = static_cast<std::uint8_t>(flag)});
    EXPECT_EQ(point.range_mm, 0U);
    EXPECT_TRUE(point.is_rain);
  }
  EXPECT_EQ(status_of({.elevation_std = nan, .invalid_flags = 0x20}), DecodeStatus::kOk);
}

TEST(ContinentalArs548, WhatIsNoPlaceIsWrong) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float wrong : {nan, infinite, -infinite, 4.0F, -4.0F}) {
    EXPECT_EQ(status_of({.azimuth = wrong}), DecodeStatus::kWrongPoint);
    EXPECT_EQ(status_of({.elevation = wrong}), DecodeStatus::kWrongPoint);
    EXPECT_EQ(status_of({.elevation_std = wrong}), DecodeStatus::kWrongPoint);
  }
  for (const float wrong : {nan, infinite, -infinite, -0.1F, 1048.6F}) {
    EXPECT_EQ(status_of({.range = wrong}), DecodeStatus::kWrongPoint);
  }
  EXPECT_EQ(status_of({.range = 0}), DecodeStatus::kOk);
  EXPECT_EQ(status_of({.range = 1048.5F}), DecodeStatus::kOk);
  EXPECT_EQ(status_of({.existence = 101}), DecodeStatus::kWrongPoint);
}

}  // namespace
}  // namespace iog::lidar
