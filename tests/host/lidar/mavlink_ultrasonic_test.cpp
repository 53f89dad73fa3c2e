// Messages of an ultrasonic unit: as another implementation writes them, and their rules.
#include <gtest/gtest.h>
#include <string_view>
#include <vector>

#include "fakes/from_hex.hpp"
#include "fakes/mavlink_distance.hpp"
#include "lidar/decoded.hpp"

namespace iog::lidar {
namespace {

using tests::from_hex;
using tests::MavlinkDistance;
using Bytes = std::vector<std::byte>;

Decoded decoded_message(const Bytes& bytes) { return {bytes, kFormat<MavlinkUltrasonic>}; }

DecodeStatus status_of(const MavlinkDistance& message) {
  return decoded_message(message.bytes()).status;
}

ScanPoint point_of(const MavlinkDistance& message) {
  const Decoded decoded = decoded_message(message.bytes());
  EXPECT_EQ(decoded.status, DecodeStatus::kOk);
  EXPECT_EQ(decoded.points.size(), 1U);
  return decoded.points.empty() ? ScanPoint{} : decoded.points.front();
}

// Written by node-mavlink 2.3.0 with mavlink-mappings 1.0.21, which are generated of common.xml:
// 1.87 m of 0.2 ... 7.65 m, 123,456 ms after its start, without the fields that came later, and
// with fields of view, a rotation and a quality of 88 %.
constexpr std::string_view kShort = "fd0e000007010184000040e201001400fd02bb0001030004a29d";
constexpr std::string_view kWhole =
    "fd27000008010184000040e201001400fd02bb0001030004db0f493f920a063f0000803f0000000000000000000000"
    "00588283";

TEST(MavlinkUltrasonic, MessagesOfAnotherImplementationAreOnePoint) {
  for (const std::string_view hex : {kShort, kWhole}) {
    const Decoded decoded = decoded_message(from_hex(hex));
    ASSERT_EQ(decoded.status, DecodeStatus::kOk) << hex;
    ASSERT_EQ(decoded.points.size(), 1U);
    EXPECT_EQ(decoded.points[0].range_mm, 1'870U);
    EXPECT_EQ(decoded.points[0].azimuth_ticks, 0);
    EXPECT_EQ(decoded.points[0].layer, 0);
    EXPECT_EQ(decoded.points[0].echo, 0);
    EXPECT_FALSE(decoded.points[0].is_rain);
    const PacketInfo& info = decoded.info;
    EXPECT_EQ(info.point_count, 1U);
    EXPECT_EQ(info.sweep.begin_us, 123'456'000U);
    EXPECT_EQ(info.sweep.end_us, 123'456'000U);
    EXPECT_TRUE(info.sweep.is_of_packet);
    EXPECT_EQ(info.sector.width_ticks, MavlinkUltrasonic::kDataSheet.scan_width_ticks);
  }
}

// What the tests make below has the bytes of the other implementation.
TEST(MavlinkUltrasonic, TheTestsOwnMessagesAreThatOfTheOtherToo) {
  EXPECT_EQ(MavlinkDistance{}.bytes(), from_hex(kShort));
}

// The same writer: a rangefinder by laser, one that looks down, a heartbeat, and MAVLink 1.
TEST(MavlinkUltrasonic, OtherMessagesOfTheOtherImplementationAreRefused) {
  const auto status_of_hex = [](std::string_view hex) {
    return decoded_message(from_hex(hex)).status;
  };
  EXPECT_EQ(status_of_hex("fd0e000009010184000040e201001400fd02bb0000030004ff96"),
            DecodeStatus::kWrongType);
  EXPECT_EQ(status_of_hex("fd0e00000b010184000040e201001400fd02bb0001031904e8ea"),
            DecodeStatus::kWrongAngle);
  EXPECT_EQ(status_of_hex("fd0500000c0101000000000000000184de"), DecodeStatus::kWrongType);
  EXPECT_EQ(status_of_hex("fe270701018440e201001400fd02bb000103000400000000000000000000000000000000"
                          "00000000000000000024b5"),
            DecodeStatus::kWrongType);
}

// Distance 0 of a unit that hears from 0 to 0 cm; the writer leaves out what is 0 at the end.
TEST(MavlinkUltrasonic, ZerosAtTheEndNeedNotBeSent) {
  const Decoded decoded =
      decoded_message(from_hex("fd0b00000a010184000000000000000000000000019ae2"));
  ASSERT_EQ(decoded.status, DecodeStatus::kOk);
  EXPECT_EQ(decoded.points.at(0).range_mm, 0U);
}

TEST(MavlinkUltrasonic, EveryBitIsUnderTheChecksum) {
  const Bytes sound = from_hex(kWhole);
  for (std::size_t bit = 0; bit < 8 * sound.size(); ++bit) {
    Bytes bytes = sound;
    bytes[bit / 8] ^= std::byte{1} << bit % 8;
    EXPECT_NE(decoded_message(bytes).status, DecodeStatus::kOk) << bit;
  }
}

TEST(MavlinkUltrasonic, ADatagramIsOneMessage) {
  const Bytes one = from_hex(kShort);
  Bytes two = one;
  two.insert(two.end(), one.begin(), one.end());
  EXPECT_EQ(decoded_message(two).status, DecodeStatus::kWrongLength);
  for (std::size_t size = 0; size < one.size(); ++size) {
    EXPECT_EQ(
        decoded_message(Bytes(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(size))).status,
        DecodeStatus::kWrongLength);
  }
  Bytes long_one(10 + 40 + 2);
  std::copy(one.begin(), one.begin() + 10, long_one.begin());
  long_one[1] = std::byte{40};
  EXPECT_EQ(decoded_message(long_one).status, DecodeStatus::kWrongLength);
}

// Flag 1 says that a signature follows, which nobody here can check; a receiver must refuse flags
// that it does not know.
TEST(MavlinkUltrasonic, FlagsThatCountAreRefused) {
  EXPECT_EQ(status_of({.flags = 1}), DecodeStatus::kWrongType);
  EXPECT_EQ(status_of({.flags = 0x80}), DecodeStatus::kWrongType);
}

TEST(MavlinkUltrasonic, AnotherLayoutFailsTheChecksum) {
  EXPECT_EQ(status_of({.layout = 84}), DecodeStatus::kWrongType);
  EXPECT_EQ(status_of({.message = 132 + 256}), DecodeStatus::kWrongType);
  EXPECT_EQ(status_of({.message = 132 + 65'536}), DecodeStatus::kWrongType);
}

TEST(MavlinkUltrasonic, OnlyUltrasonicUnitsThatLookAsideAreTaken) {
  for (int kind = 0; kind < 256; ++kind) {
    EXPECT_EQ(status_of({.kind = static_cast<std::uint8_t>(kind)}),
              kind == 1 ? DecodeStatus::kOk : DecodeStatus::kWrongType);
  }
  for (int orientation = 0; orientation < 256; ++orientation) {
    const bool looks_aside = orientation < 8 || orientation == 12;
    EXPECT_EQ(status_of({.orientation = static_cast<std::uint8_t>(orientation)}),
              looks_aside ? DecodeStatus::kOk : DecodeStatus::kWrongAngle)
        << orientation;
  }
}

// Nothing was heard: no distance, and so nothing is free.
TEST(MavlinkUltrasonic, TheLongestDistanceIsNoEcho) {
  EXPECT_EQ(point_of({.current_cm = 764}).range_mm, 7'640U);
  for (const int cm : {765, 766, 65'535}) {
    const ScanPoint point = point_of({.current_cm = static_cast<std::uint16_t>(cm)});
    EXPECT_EQ(point.range_mm, 0U) << cm;
  }
  EXPECT_EQ(point_of({.most_cm = 65'535, .current_cm = 65'534}).range_mm, 655'340U);
}

TEST(MavlinkUltrasonic, WhatTheUnitDoesNotBelieveIsRain) {
  EXPECT_FALSE(point_of({.current_cm = 20}).is_rain);
  EXPECT_TRUE(point_of({.current_cm = 19}).is_rain);
  EXPECT_TRUE(point_of({.quality = 1}).is_rain);
  EXPECT_FALSE(point_of({.quality = 0}).is_rain);
  EXPECT_FALSE(point_of({.quality = 2}).is_rain);
  EXPECT_FALSE(point_of({.quality = 100}).is_rain);
}

TEST(MavlinkUltrasonic, TwoCyclesAreTwoScans) {
  const auto info_of = [](const MavlinkDistance& message) {
    return decoded_message(message.bytes()).info;
  };
  const PacketInfo first = info_of({.time_ms = 1'000});
  const PacketInfo next = info_of({.time_ms = 1'010, .sequence = 8});
  EXPECT_NE(first.scan_number, next.scan_number);
  EXPECT_NE(first.fingerprint, next.fingerprint);
  EXPECT_NE(first.fingerprint, info_of({.time_ms = 1'000, .sequence = 8}).fingerprint);
}

}  // namespace
}  // namespace iog::lidar
