// Packets are known without a description of their unit; those of nobody have no name.
#include "tools/identity/unit_watch.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/foreign_packets.hpp"
#include "fakes/hesai_packet.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/ouster_packet.hpp"
#include "fakes/points_packet.hpp"
#include "fakes/velodyne_packet.hpp"

namespace iog::tools {
namespace {

std::string name_seen(const std::vector<std::byte>& payload) {
  return UnitWatch{}.take(payload).name;
}

TEST(UnitWatch, KnowsEachProfileByItsLengthAndItsColumns) {
  using tests::OusterPacket;
  EXPECT_EQ(name_seen(OusterPacket{}.bytes()), "Ouster OS, legacy 64");
  EXPECT_EQ(
      name_seen(OusterPacket{.format = lidar::kFormat<lidar::OusterRng15>, .rows = 128}.bytes()),
      "Ouster OS, RNG15 128");
  EXPECT_EQ(
      name_seen(OusterPacket{.format = lidar::kFormat<lidar::OusterRng19>, .rows = 32}.bytes()),
      "Ouster OS, RNG19 32");
  OusterPacket dual{.format = lidar::kFormat<lidar::OusterRng19Dual>, .rows = 32};
  EXPECT_EQ(name_seen(dual.bytes()), "Ouster OS, RNG19 dual 32");
  EXPECT_FALSE(UnitWatch{}.take(dual.bytes()).is_in_doubt);
  EXPECT_EQ(name_seen(OusterPacket{.columns_per_turn = 2048, .column_ns = 48'828}.bytes()),
            "Ouster OS, legacy 64");
  dual.rows = 128;
  EXPECT_EQ(name_seen(dual.bytes()), "Ouster OS, RNG19 dual 128");
  const auto bytes = OusterPacket{.frame = 77}.bytes();
  const SeenUnit seen = UnitWatch{}.take(bytes);
  EXPECT_TRUE(seen.is_sound);
  EXPECT_TRUE(seen.is_numbered);
  EXPECT_EQ(seen.info.scan_number, 77U);
  EXPECT_EQ(seen.ticks_per_turn, 46'080U);
}

TEST(UnitWatch, PointsMayBeOfWhatTurns) {
  const auto bytes = tests::PointsPacket{.points = {{.third = 5}}}.bytes();
  const SeenUnit seen = UnitWatch().take(bytes);
  EXPECT_EQ(seen.name, "points");
  EXPECT_TRUE(seen.is_sound && seen.is_numbered);
  EXPECT_TRUE(seen.formats.has(lidar::kFormat<lidar::Points>));
  EXPECT_TRUE(seen.formats.has(lidar::kFormat<lidar::PointsTurning>));
}

// The sky at night: 128 rows, or 32 with two returns.
TEST(UnitWatch, AnOusterThatSeesNothingMayBeOfTwoProfiles) {
  auto bytes =
      tests::OusterPacket{.format = lidar::kFormat<lidar::OusterRng15>, .rows = 128}.bytes();
  for (std::size_t column = 0; column < 16; ++column) {
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(32 + 524 * column + 12), 512,
                std::byte{0});
  }
  const SeenUnit seen = UnitWatch{}.take(bytes);
  EXPECT_EQ(seen.name, "Ouster OS, RNG15 128 or Ouster OS, RNG19 dual 32");
  EXPECT_TRUE(seen.is_in_doubt);
  EXPECT_TRUE(seen.formats.has(lidar::kFormat<lidar::OusterRng15>));
  EXPECT_TRUE(seen.formats.has(lidar::kFormat<lidar::OusterRng19Dual>));
}

TEST(UnitWatch, KnowsEachHesaiByItsHeadOrItsFlags) {
  for (const lidar::Format format : tests::kHesaiFormats) {
    const auto bytes = tests::HesaiPacket{.format = format}.bytes();
    EXPECT_EQ(name_seen(bytes), lidar::name_of(format));
    EXPECT_TRUE(UnitWatch{}.take(bytes).is_sound);
  }
  EXPECT_FALSE(UnitWatch{}.take(tests::HesaiPacket{}.bytes()).is_numbered);
}

// Nothing in it tells four layers from eight.
TEST(UnitWatch, AScanOfALuxMayBeOfEither) {
  const SeenUnit seen = UnitWatch{}.take(tests::LuxMessage{.scan_number = 7}.bytes());
  EXPECT_EQ(seen.name, "ibeo LUX");
  EXPECT_TRUE(seen.formats.has(lidar::kFormat<lidar::IbeoLux>));
  EXPECT_TRUE(seen.formats.has(lidar::kFormat<lidar::IbeoLux8>));
  EXPECT_FALSE(seen.is_in_doubt);
}

TEST(UnitWatch, NamesWhatIsNotTaken) {
  for (const tests::ForeignPacket& packet : tests::foreign_packets()) {
    const SeenUnit seen = UnitWatch{}.take(packet.bytes);
    EXPECT_EQ(seen.name, packet.name);
    EXPECT_TRUE(seen.formats.is_empty()) << packet.name;
    EXPECT_FALSE(seen.is_sound) << packet.name;
  }
}

// A unit that is taken, in a mode that is not: 0x3D is three returns.
TEST(UnitWatch, AnUnknownModeLeavesTheName) {
  for (const lidar::Format format : tests::kHesaiFormats) {
    const auto bytes = tests::HesaiPacket{.format = format, .mode = 0x3D}.bytes();
    EXPECT_EQ(name_seen(bytes), lidar::name_of(format));
    EXPECT_TRUE(UnitWatch{}.take(bytes).formats.is_empty());
  }
}

TEST(UnitWatch, WhatIsOfNobodyHasNoName) {
  EXPECT_EQ(name_seen({}), "");
  EXPECT_EQ(name_seen(std::vector<std::byte>(12'608)), "");
  for (const tests::ForeignPacket& packet : tests::foreign_packets()) {
    for (const std::size_t size : {1U, 3U, 7U, 12U, 36U, 200U}) {
      std::vector<std::byte> cut = packet.bytes;
      cut.resize(size);
      const bool is_known_by_its_first_bytes = packet.name.starts_with("RoboSense") && size >= 8;
      EXPECT_EQ(name_seen(cut).empty(), !is_known_by_its_first_bytes) << packet.name << size;
    }
  }
}

}  // namespace
}  // namespace iog::tools
