// No unit is taken for another: by real packets, and by made-up ones at every speed.
#include "lidar/velodyne_identity.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/foreign_packets.hpp"
#include "fakes/from_hex.hpp"
#include "fakes/random.hpp"
#include "fakes/real_velodyne_packets.hpp"
#include "fakes/real_vls128_packet.hpp"
#include "fakes/velodyne_packet.hpp"

namespace iog::lidar {
namespace {

using Packet = tests::VelodynePacket;

constexpr FormatSet kHdl32e(kFormat<VelodyneHdl32e>);
constexpr FormatSet kVlp16(kFormat<VelodyneVlp16>);
FormatSet either() {
  FormatSet set = kHdl32e;
  set.add(kFormat<VelodyneVlp16>);
  return set;
}
const FormatSet kEither = either();

// A unit at so many turns a second, its manual's time of a block, and how many packets hold.
struct Unit {
  double block_us;
  int mode = 0x37;
  int product = 0x21;
  int blocks_of_azimuth = 1;
  int banks = 1;

  [[nodiscard]] double packet_us() const { return 12 / blocks_of_azimuth * block_us; }

  // The packet that begins at that time; azimuths are rounded down, each for itself.
  [[nodiscard]] std::vector<std::byte> packet_at(double time_us, double hertz) const {
    auto bytes = Packet{.mode = mode,
                        .product = product,
                        .time_us = static_cast<std::uint32_t>(time_us),
                        .blocks_of_azimuth = blocks_of_azimuth,
                        .banks = banks}
                     .bytes();
    for (int block = 0; block < 12; ++block) {
      const double at_us = time_us + block / blocks_of_azimuth * block_us;
      const auto azimuth = static_cast<std::uint64_t>(at_us * hertz * 0.036) % 36'000;
      bytes[static_cast<std::size_t>(block) * 100 + 2] = static_cast<std::byte>(azimuth);
      bytes[static_cast<std::size_t>(block) * 100 + 3] = static_cast<std::byte>(azimuth >> 8);
    }
    return bytes;
  }
};

constexpr Unit kHdl32eUnit21{.block_us = 46.08};
constexpr Unit kHdl32eDual{.block_us = 46.08, .mode = 0x39, .blocks_of_azimuth = 2};
constexpr Unit kVlp16Unit21{.block_us = 110.592};
constexpr Unit kVlp16Dual21{.block_us = 110.592, .mode = 0x39, .blocks_of_azimuth = 2};
constexpr Unit kHdl64eS2{.block_us = 48.0, .blocks_of_azimuth = 2, .banks = 2};
constexpr Unit kHdl64eS3{.block_us = 57.6, .blocks_of_azimuth = 2, .banks = 2};
constexpr Unit kHdl64eS3Dual{.block_us = 57.6, .blocks_of_azimuth = 4, .banks = 2};

// At 11.8 Hz an HDL-32E turns as much in a block as a VLP-16 at 5 Hz.
TEST(VelodyneIdentity, ARealHdl32eIsKnownByItsSecondPacket) {
  VelodyneIdentity identity;
  EXPECT_EQ(identity.add(tests::from_hex(tests::kHdl32eFirst)), kEither);
  EXPECT_EQ(identity.add(tests::from_hex(tests::kHdl32eSecond)), kHdl32e);
}

// At 20 Hz no HDL-32E turns so much in a block.
TEST(VelodyneIdentity, ARealVlp16OfOldFirmwareIsKnownByItsFirst) {
  VelodyneIdentity identity;
  EXPECT_EQ(identity.add(tests::from_hex(tests::kOldVlp16First)), kVlp16);
  EXPECT_EQ(identity.add(tests::from_hex(tests::kOldVlp16Second)), kVlp16);
}

TEST(VelodyneIdentity, WhatSaysItsNameIsBelieved) {
  VelodyneIdentity identity;
  EXPECT_EQ(identity.add(tests::from_hex(tests::kVlp32c)), FormatSet(kFormat<VelodyneVlp32c>));
  EXPECT_EQ(identity.add(Packet{.product = 0x24}.bytes()), FormatSet(kFormat<VelodynePuckHires>));
  EXPECT_EQ(identity.add(Packet{}.bytes()), kVlp16);
  EXPECT_TRUE(identity.add(Packet{.product = 0x23}.bytes()).is_empty());
  EXPECT_TRUE(identity.add(std::span<const std::byte>()).is_empty());
  EXPECT_EQ(identity.add(tests::from_hex(tests::kVls128)), FormatSet(kFormat<VelodyneVls128>));
  EXPECT_TRUE(identity.add(tests::vls128_packet()).is_empty()) << "two returns";
}

// Whatever was lost, repeated or came late, and at whatever speed: a packet is called the other
// unit's never, and its own unit's soon.
void expect_known(const Unit& unit, FormatSet its, std::uint64_t seed) {
  tests::Random random(seed);
  for (int run = 0; run < tests::effort(60, 10); ++run) {
    const double hertz = random.between(500, 2'000) / 100.0;
    VelodyneIdentity identity;
    double time_us = random.between(0, 1'000'000);
    int in_doubt = 0;
    for (int i = 0; i < 200; ++i) {
      const double late_us = random.one_in(10) ? -2 * unit.packet_us() : 0;
      const FormatSet possible = identity.add(unit.packet_at(time_us + late_us, hertz));
      ASSERT_TRUE(possible.has(its.first())) << hertz << " Hz, packet " << i;
      in_doubt += possible == its ? 0 : 1;
      time_us += unit.packet_us() * (random.one_in(5) ? random.between(0, 9) : 1);
    }
    ASSERT_LE(in_doubt, 12) << hertz << " Hz";
  }
}

TEST(VelodyneIdentity, NoUnitIsTakenForAnotherAtAnySpeed) {
  expect_known(kHdl32eUnit21, kHdl32e, 1);
  expect_known(kHdl32eDual, kHdl32e, 2);
  expect_known(kVlp16Unit21, kVlp16, 3);
  expect_known(kVlp16Dual21, kVlp16, 4);
  expect_known(kHdl64eS2, FormatSet(kFormat<VelodyneHdl64eS2>), 5);
  expect_known(kHdl64eS3, FormatSet(kFormat<VelodyneHdl64eS3>), 6);
  expect_known(kHdl64eS3Dual, FormatSet(kFormat<VelodyneHdl64eS3>), 7);
}

// From one packet alone: at 10 Hz each gains what the other cannot, in between nobody knows.
TEST(VelodyneIdentity, OnePacketIsEnoughWhereTheOtherUnitCannotTurnSo) {
  const auto first_of = [](const Unit& unit, double hertz) {
    return VelodyneIdentity().add(unit.packet_at(1'000, hertz));
  };
  EXPECT_EQ(first_of(kHdl32eUnit21, 10), kHdl32e);
  EXPECT_EQ(first_of(kVlp16Unit21, 10), kVlp16);
  EXPECT_EQ(first_of(kHdl32eUnit21, 15), kEither);
  EXPECT_EQ(first_of(kVlp16Unit21, 6), kEither);
  EXPECT_EQ(first_of(kVlp16Unit21, 0), kEither);  // the head stands
}

// The clock of a unit counts from the hour.
TEST(VelodyneIdentity, TheHourBreaksNoRow) {
  VelodyneIdentity identity;
  static_cast<void>(identity.add(kHdl32eUnit21.packet_at(3'599'999'900, 12)));
  auto second = kHdl32eUnit21.packet_at(3'599'999'900 + 553, 12);
  second[1200] = std::byte{197};  // 453 us past the hour
  second[1201] = std::byte{1};
  second[1202] = second[1203] = std::byte{0};
  EXPECT_EQ(identity.add(second), kHdl32e);
}

// After a pause it may be another unit's turn to be plugged in.
TEST(VelodyneIdentity, AfterAPauseNothingIsKnown) {
  VelodyneIdentity identity;
  static_cast<void>(identity.add(kHdl32eUnit21.packet_at(1'000, 12)));
  EXPECT_EQ(identity.add(kHdl32eUnit21.packet_at(1'553, 12)), kHdl32e);
  EXPECT_EQ(identity.add(kVlp16Unit21.packet_at(2'000'000, 6)), kEither);
  EXPECT_EQ(identity.add(kVlp16Unit21.packet_at(2'001'327, 6)), kVlp16);
}

TEST(VelodyneIdentity, AnyBytesWillDo) {
  tests::Random random(99);
  VelodyneIdentity identity;
  for (int i = 0; i < tests::effort(5'000, 300); ++i) {
    auto bytes = kHdl32eUnit21.packet_at(random.between(0, 100'000), random.between(0, 30));
    bytes.resize(static_cast<std::size_t>(random.one_in(5) ? random.between(0, 1'206) : 1'206));
    for (int flips = bytes.empty() ? 0 : random.between(0, 3); flips > 0; --flips) {
      bytes[static_cast<std::size_t>(random.between(0, static_cast<int>(bytes.size()) - 1))] =
          static_cast<std::byte>(random.next());
    }
    const FormatSet possible = identity.add(bytes);
    ASSERT_FALSE(possible.has(kFormat<IbeoLux>));
  }
}

}  // namespace
}  // namespace iog::lidar
