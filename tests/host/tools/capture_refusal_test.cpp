// Why a capture is not a car's: no refusal contradicts itself, and what it advises fits.
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "fakes/foreign_packets.hpp"
#include "fakes/hesai_packet.hpp"
#include "fakes/ouster_packet.hpp"
#include "fakes/points_packet.hpp"
#include "fakes/velodyne_packet.hpp"
#include "tools/identity/capture_identity.hpp"

namespace iog::tools {
namespace {

using Payload = std::vector<std::byte>;

void add(CaptureIdentity& identity, std::uint16_t port, const Payload& payload) {
  identity.add({.source = {.ipv4 = 0xC0A801C9, .port = 2368},
                .destination = {.ipv4 = 0xFFFFFFFF, .port = port},
                .payload = payload});
}

Payload vlp16_packet(int number, int mode = 0x37) {
  return tests::VelodynePacket{.first_azimuth = number * 480 % 36'000,
                               .mode = mode,
                               .time_us = static_cast<std::uint32_t>(number) * 1327}
      .bytes();
}

std::string refusal_by(const CaptureIdentity& identity, const char* car) {
  return identity.refusal(find_vehicle(car));
}

// VLP-16 User Manual, "Return Mode": 0x37, 0x38 and 0x39 are all that it names.
TEST(CaptureRefusal, AUnitOfTheCarInAnUnknownModeIsNoOther) {
  CaptureIdentity identity;
  for (int i = 0; i < 40; ++i) {
    add(identity, 2368, vlp16_packet(i, 0x3B));
  }
  for (const char* const car : {"roof_vlp16", "roof_hdl32e"}) {
    EXPECT_EQ(refusal_by(identity, car),
              "UDP port 2368 receives a Velodyne VLP-16 in an unsupported mode (docs/sensors.md, "
              "\"Two returns\")");
  }
  EXPECT_EQ(identity.words_of_best().find("no car that iog knows: UDP port 2368 receives a "
                                          "Velodyne VLP-16 in an unsupported mode"),
            0U);
  add(identity, 2368, vlp16_packet(40));
  EXPECT_EQ(refusal_by(identity, "roof_vlp16"), "");
}

// 0xC000 hundredths of a degree are more than a turn.
TEST(CaptureRefusal, AUnitOfTheCarWhosePacketsAreDamagedIsNoOther) {
  CaptureIdentity identity;
  for (int i = 0; i < 40; ++i) {
    Payload packet = vlp16_packet(i);
    packet[3] |= std::byte{0xC0};
    add(identity, 2368, packet);
  }
  EXPECT_EQ(refusal_by(identity, "roof_vlp16"),
            "UDP port 2368 receives a Velodyne VLP-16 whose packets are damaged: record it again");
}

TEST(CaptureRefusal, AnotherUnitDoesNotHideThatTheCarsIsInAnUnknownMode) {
  CaptureIdentity identity;
  for (const tests::ForeignPacket& packet : tests::foreign_packets()) {
    if (packet.name == "Velodyne VLS-128") {
      add(identity, 2368, packet.bytes);
    }
  }
  for (int i = 0; i < 40; ++i) {
    add(identity, 2369, vlp16_packet(i));
  }
  EXPECT_EQ(refusal_by(identity, "roof_vls128"),
            "UDP port 2368 receives a Velodyne VLS-128 in an unsupported mode; UDP port 2369 "
            "receives a Velodyne VLP-16");
}

TEST(CaptureRefusal, OfTwoUnitsOnAPortBothAreAdvised) {
  CaptureIdentity identity;
  for (int i = 0; i < 40; ++i) {
    add(identity, 2368, vlp16_packet(i));
    add(identity, 2368,
        tests::HesaiPacket{.format = lidar::kFormat<lidar::HesaiPandar64>,
                           .first_azimuth = i * 120,
                           .time_us = static_cast<std::uint32_t>(i) * 333}
            .bytes());
  }
  EXPECT_EQ(refusal_by(identity, "roof_xt32"),
            "UDP port 2368 receives a Hesai Pandar64 and a Velodyne VLP-16, but sensor "
            "roof of roof_xt32 is a Hesai PandarXT-32: try --vehicle roof_pandar64 or roof_vlp16");
  EXPECT_EQ(refusal_by(identity, "roof_vlp16"), "");
}

// Firmware User Manual, "lidar_mode": 512 columns ten times a second.
TEST(CaptureRefusal, AnOusterInAnotherModeIsNamedSo) {
  CaptureIdentity identity;
  for (int i = 0; i < 10; ++i) {
    add(identity, 7502,
        tests::OusterPacket{
            .columns_per_turn = 512,
            .first_column = 16 * i,
            .time_ns = 1'000'000'000'000 + static_cast<std::uint64_t>(i) * 3'125'000,
            .column_ns = 195'312}
            .bytes());
  }
  EXPECT_EQ(refusal_by(identity, "roof_os1_64"),
            "UDP port 7502 receives an Ouster OS, legacy 64 in another mode, but sensor "
            "roof of roof_os1_64 is an Ouster OS, legacy 64, 1024x10: no car that iog knows has it "
            "there; docs/vehicles.md says how to describe one");
}

// What comes to another port fits other cars as well, but not what is told.
TEST(CaptureRefusal, TheCarOfTheUnitThatIsToldIsAdvised) {
  CaptureIdentity identity;
  for (int i = 0; i < 40; ++i) {
    add(identity, 2368, vlp16_packet(i));
    add(identity, 9870, tests::PointsPacket{}.bytes());
  }
  EXPECT_EQ(refusal_by(identity, "roof_hdl32e"),
            "UDP port 2368 receives a Velodyne VLP-16, but sensor roof of roof_hdl32e "
            "is a Velodyne HDL-32E: try --vehicle roof_vlp16");
  EXPECT_EQ(
      refusal_by(identity, "roof_os1_64")
          .find("no packet is for a sensor of roof_os1_64 (Ouster OS, legacy 64, 1024x10; UDP port "
                "7502); UDP port 2368 receives a Velodyne VLP-16; "),
      0U)
      << refusal_by(identity, "roof_os1_64");
}

}  // namespace
}  // namespace iog::tools
