// Whose capture is this? `iog info` and what refuses a capture give one answer, and vehicles that
// share UDP ports are told apart by what their sensors send.
#include "tools/identity/capture_identity.hpp"

#include <array>
#include <gtest/gtest.h>
#include <optional>

#include "drive_sample.hpp"
#include "fakes/foreign_packets.hpp"
#include "fakes/hesai_packet.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/temporary_folder.hpp"
#include "fakes/velodyne_packet.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/info/file_summary.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

using Payload = std::vector<std::byte>;

// A capture of such payloads, one every period.
class Capture {
 public:
  void add(std::uint16_t port, std::uint64_t time_us, const Payload& payload,
           std::uint32_t source_ipv4 = 0xC0A801C9) {
    file_->write({.time_us = time_us,
                  .source = {.ipv4 = source_ipv4, .port = 2368},
                  .destination = {.ipv4 = 0xFFFFFFFF, .port = port},
                  .payload = payload});
  }

  // What refuses it to a car says; empty: it is the car's.
  [[nodiscard]] std::string refusal_by(const char* car) {
    finish();
    try {
      demand_fit({path_}, find_vehicle(car));
    } catch (const UsageError& error) {
      return error.what();
    }
    return {};
  }

  [[nodiscard]] std::string info() {
    finish();
    return summary_of_capture(path_);
  }

 private:
  void finish() {
    if (file_) {
      file_->finish();
      file_.reset();
    }
  }

  tests::TemporaryFolder folder_;
  std::string path_ = folder_ / "some.pcap";
  std::optional<PcapWriter> file_{path_};
};

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

Payload vlp16_packet(int number) {
  return tests::VelodynePacket{.first_azimuth = number * 480 % 36'000,
                               .step = 40,
                               .time_us = static_cast<std::uint32_t>(number) * 1327}
      .bytes();
}

Payload hesai_packet(lidar::Format format, int number) {
  return tests::HesaiPacket{.format = format,
                            .first_azimuth = number * 120 % 36'000,
                            .time_us = static_cast<std::uint32_t>(number) * 333}
      .bytes();
}

// A scan of a LUX of so many directions, so many ticks apart.
Payload scan(int number, int directions, int step_ticks) {
  tests::LuxMessage message{.scan_number = static_cast<std::uint16_t>(number), .points = {}};
  for (int i = 0; i < directions; ++i) {
    message.points.push_back({.angle_ticks = 1600 - i * step_ticks, .range_cm = 2000});
  }
  return message.bytes();
}

TEST(CaptureIdentity, WhatAHeaderNamesIsNamedWhetherItIsTakenOrNot) {
  for (const tests::ForeignPacket& packet : tests::foreign_packets()) {
    for (const char* const car : {"reference_car", "roof_hdl32e", "roof_hdl64e"}) {
      Capture capture;
      for (int i = 0; i < 3; ++i) {
        capture.add(2368, 1'000'000 + static_cast<std::uint64_t>(i) * 1000, packet.bytes);
      }
      const std::string refusal = capture.refusal_by(car);
      EXPECT_TRUE(contains(refusal, " " + std::string(packet.name))) << refusal;
      const bool is_of_ours = packet.name == "Velodyne VLS-128";
      EXPECT_TRUE(contains(refusal, is_of_ours ? "VLS-128 in an unsupported mode"
                                               : ", which iogrid does not support"))
          << refusal;
      EXPECT_FALSE(contains(refusal, "--vehicle")) << refusal;
      EXPECT_TRUE(contains(capture.info(), packet.name)) << capture.info();
    }
  }
}

// PandarXT User Manual, "Return mode": 0x3D is three returns.
TEST(CaptureIdentity, AUnitInAModeThatIsNotTakenIsNamedSo) {
  Capture capture;
  for (const std::uint64_t time_us : {1U, 2U, 3U}) {
    capture.add(
        2368, time_us,
        tests::HesaiPacket{.format = lidar::kFormat<lidar::HesaiXt32m>, .mode = 0x3D}.bytes());
  }
  const std::string refusal = capture.refusal_by("roof_xt32m");
  EXPECT_TRUE(contains(refusal, "Hesai PandarXT-32M in an unsupported mode")) << refusal;
  EXPECT_TRUE(contains(capture.info(), "in an unsupported mode")) << capture.info();
}

TEST(CaptureIdentity, GarbageHasNoName) {
  Capture capture;
  capture.add(2368, 1, Payload(1206));
  capture.add(2368, 2, {std::byte{0xEE}, std::byte{0xFF}, std::byte{6}, std::byte{1}});
  Payload short_of_its_blocks = tests::hesai_header_packet(6, 1, 16, 8, 568);
  short_of_its_blocks.resize(300);
  capture.add(2368, 3, short_of_its_blocks);
  EXPECT_TRUE(contains(capture.info(), "other")) << capture.info();
  EXPECT_TRUE(contains(capture.refusal_by("reference_car"), "of no lidar that iog knows"));
}

// Many cars have a scanner on port 2368; the one that fits is named, to whoever asks.
TEST(CaptureIdentity, TheFittingCarIsNamedToEveryOther) {
  Capture of_vlp16;
  for (int i = 0; i < 40; ++i) {
    of_vlp16.add(2368, static_cast<std::uint64_t>(i) * 1'327, vlp16_packet(i));
  }
  EXPECT_EQ(of_vlp16.refusal_by("roof_vlp16"), "");
  for (const char* const car : {"reference_car", "roof_hdl32e", "roof_hdl64e", "roof_xt32"}) {
    const std::string vlp16 = of_vlp16.refusal_by(car);
    EXPECT_TRUE(contains(vlp16, "receives a Velodyne VLP-16")) << vlp16;
    EXPECT_TRUE(vlp16.ends_with(": try --vehicle roof_vlp16")) << vlp16;
  }
}

TEST(CaptureIdentity, EachHesaiIsOfItsOwnCarAlone) {
  const std::array<const char*, 7> cars{"roof_pandar40p", "roof_pandar64", "roof_qt64",
                                        "roof_qt128",     "roof_xt16",     "roof_xt32",
                                        "roof_xt32m"};
  for (std::size_t unit = 0; unit < cars.size(); ++unit) {
    const lidar::Format format = tests::kHesaiFormats[unit];
    Capture capture;
    for (int i = 0; i < 40; ++i) {
      capture.add(2368, static_cast<std::uint64_t>(i) * 332, hesai_packet(format, i));
    }
    EXPECT_EQ(capture.refusal_by(cars[unit]), "");
    for (const char* const car : {"reference_car", "roof_hdl32e", "roof_hdl64e", cars[0], cars[1],
                                  cars[2], cars[3], cars[4], cars[5], cars[6]}) {
      if (car != cars[unit]) {
        const std::string refusal = capture.refusal_by(car);
        EXPECT_TRUE(contains(refusal, "receives a " + std::string(lidar::name_of(format))))
            << refusal;
        EXPECT_TRUE(refusal.ends_with(": try --vehicle " + std::string(cars[unit]))) << refusal;
      }
    }
  }
}

// The packets are those of a VLP-16 but for the byte that names the unit.
TEST(CaptureIdentity, APuckHiResIsNoVlp16) {
  Capture capture;
  for (int i = 0; i < 40; ++i) {
    auto bytes = vlp16_packet(i);
    bytes[1205] = std::byte{0x24};
    capture.add(2368, static_cast<std::uint64_t>(i) * 1'327, bytes);
  }
  EXPECT_EQ(capture.refusal_by("roof_puck_hires"), "");
  const std::string refusal = capture.refusal_by("roof_vlp16");
  EXPECT_TRUE(contains(refusal, "receives a Velodyne Puck Hi-Res")) << refusal;
  EXPECT_TRUE(refusal.ends_with(": try --vehicle roof_puck_hires")) << refusal;
}

// An old VLP-16 calls itself what an HDL-32E does.
TEST(CaptureIdentity, InfoNamesOnlyTheCarThatFits) {
  Capture capture;
  for (int i = 0; i < 40; ++i) {
    auto bytes = vlp16_packet(i);
    bytes[1205] = std::byte{0x21};
    capture.add(2368, static_cast<std::uint64_t>(i) * 1'327, bytes);
  }
  const std::string info = capture.info();
  EXPECT_TRUE(contains(info, "looks like            roof_vlp16\n")) << info;
}

// Factory settings send all units of a maker to one port.
TEST(CaptureIdentity, TwoUnitsOnAPortThatNamesNoneAreTold) {
  Capture capture;
  for (int i = 0; i < 40; ++i) {
    capture.add(2368, static_cast<std::uint64_t>(i) * 1'327, vlp16_packet(i), 0x0A000264);
    capture.add(2368, static_cast<std::uint64_t>(i) * 1'327, vlp16_packet(i + 37), 0x0A000265);
  }
  const std::string words =
      "2 units send to UDP port 2368 (10.0.2.100, 10.0.2.101): set source_ipv4 of sensor roof in "
      "the car file";
  EXPECT_TRUE(capture.refusal_by("roof_vlp16").ends_with(": " + words));
  EXPECT_TRUE(contains(capture.info(), "looks like            roof_vlp16, but " + words))
      << capture.info();
  EXPECT_EQ(capture.refusal_by("roof_vlp16_radar"), "");  // names 10.0.2.101
}

// Three of ten packets, each of which sweeps a little more than it lies behind the one before.
TEST(CaptureIdentity, LostPacketsOfATurningUnitAreTold) {
  for (const int kept_of_ten : {10, 7}) {
    Capture capture;
    for (int i = 0; i < 800; ++i) {
      if (i * 7 % 10 < kept_of_ten) {
        capture.add(2368, static_cast<std::uint64_t>(i) * 1'327, vlp16_packet(i));
      }
    }
    EXPECT_EQ(contains(capture.info(), "192.168.1.201: about 28 % of the directions are missing"),
              kept_of_ten == 7)
        << capture.info();
  }
}

// The first one has then sent more packets than are looked at.
TEST(CaptureIdentity, ASecondUnitThatStartsLaterIsTold) {
  Capture capture;
  for (int i = 0; i < 1'000; ++i) {
    const auto time_us = static_cast<std::uint64_t>(i) * 1'327;
    capture.add(2368, time_us, vlp16_packet(i), 0x0A000264);
    if (i > 600) {
      capture.add(2368, time_us, vlp16_packet(i + 37), 0x0A000265);
    }
  }
  EXPECT_TRUE(contains(capture.info(), "2 units send to UDP port 2368 (10.0.2.100, 10.0.2.101)"))
      << capture.info();
}

TEST(CaptureIdentity, SendersWithoutNumberAreBounded) {
  Capture capture;
  for (int round = 0; round < 2; ++round) {
    for (std::uint32_t i = 0; i < 100; ++i) {
      capture.add(2368, (100U * static_cast<std::uint64_t>(round) + i) * 1'327,
                  vlp16_packet(static_cast<int>(i)), 0x0A000264 + i);
    }
  }
  EXPECT_TRUE(contains(capture.info(), "64 units send to UDP port 2368 (10.0.2.100, "))
      << capture.info();
  EXPECT_TRUE(contains(capture.info(), ", and packets of further senders): set source_ipv4"));
}

TEST(CaptureIdentity, AUnitWhoseAddressChangesIsOne) {
  Capture capture;
  for (int i = 0; i < 80; ++i) {
    capture.add(2368, static_cast<std::uint64_t>(i) * 1'327, vlp16_packet(i),
                i < 40 ? 0x0A000264 : 0x0A000265);
  }
  EXPECT_EQ(capture.refusal_by("roof_vlp16"), "");
  EXPECT_FALSE(contains(capture.info(), "units send")) << capture.info();
}

// Two LUX of a quarter of a degree on two of the reference car's four ports.
TEST(CaptureIdentity, FinerScansThanTheCarsAreAnotherCars) {
  Capture parking;
  Capture reference;
  for (int i = 0; i < 20; ++i) {
    const auto time_us = static_cast<std::uint64_t>(i) * 40'000;
    parking.add(12002, time_us, scan(i, 401, 8));
    parking.add(12003, time_us, scan(i, 401, 8));
    reference.add(12002, time_us, scan(i, 201, 16));
    reference.add(12003, time_us, scan(i, 201, 16));
  }
  const std::string refusal = parking.refusal_by("reference_car");
  EXPECT_TRUE(contains(refusal, "0.25 degrees apart")) << refusal;
  EXPECT_TRUE(refusal.ends_with(": try --vehicle two_lux_parking")) << refusal;
  EXPECT_EQ(parking.refusal_by("two_lux_parking"), "");
  // Two of its own four are silent, and a simulated LUX has half a degree whatever the car.
  EXPECT_EQ(reference.refusal_by("reference_car"), "");
  EXPECT_EQ(reference.refusal_by("two_lux_parking"), "");
}

// Turns a second by what was turned, not by the turns that were begun: 76 packets of 12 blocks at
// 0.8 degrees are two turns of 50 ms.
TEST(CaptureIdentity, TheRateOfAShortCaptureIsThatOfTheUnit) {
  Capture twenty_hertz;
  for (int i = 0; i < 76; ++i) {
    const auto bytes = tests::VelodynePacket{.first_azimuth = i * 960 % 36'000,
                                             .step = 80,
                                             .time_us = static_cast<std::uint32_t>(i) * 1333}
                           .bytes();
    twenty_hertz.add(2368, static_cast<std::uint64_t>(i) * 4'000 / 3, bytes);
  }
  EXPECT_TRUE(contains(twenty_hertz.info(), " 20.0 Hz")) << twenty_hertz.info();
  // Of half a turn, too: 30 packets, of which some are lost.
  Capture ten_hertz;
  for (int i = 0; i < 38; ++i) {
    if (i % 7 != 3) {
      ten_hertz.add(2368, static_cast<std::uint64_t>(i) * 4'000 / 3, vlp16_packet(i));
    }
  }
  EXPECT_TRUE(contains(ten_hertz.info(), " 10.0 Hz")) << ten_hertz.info();
}

const CatalogueEntry& reference() { return find_vehicle("reference_car"); }
const CatalogueEntry& parking() { return find_vehicle("two_lux_parking"); }

CaptureIdentity of_drive(const CatalogueEntry& car) {
  CaptureIdentity identity;
  for (const CapturedDatagram& datagram : sample_drive(car, 1, 1)) {
    identity.add(datagram);
  }
  return identity;
}

void add_scan(CaptureIdentity& identity, std::uint16_t port, const std::vector<std::byte>& bytes) {
  identity.add({.source = {}, .destination = {.port = port}, .payload = bytes});
}

// Two LUX of a quarter of a degree, as the recording of the parking lot has them.
CaptureIdentity of_parking_lot() {
  CaptureIdentity identity;
  for (const std::uint16_t port : {std::uint16_t{12002}, std::uint16_t{12003}}) {
    add_scan(identity, port, scan(1, 401, 8));
  }
  return identity;
}

TEST(CaptureIdentity, EachVehiclesOwnScansAreItsOwn) {
  const CaptureIdentity drive = of_drive(reference());
  EXPECT_TRUE(drive.misfits(reference()).empty());
  EXPECT_EQ(drive.words(reference()), "");
  EXPECT_EQ(drive.words_of_best(), "reference_car");
  const CaptureIdentity lot = of_parking_lot();
  EXPECT_TRUE(lot.misfits(parking()).empty());
  EXPECT_EQ(lot.words(parking()), "");
  EXPECT_EQ(lot.words_of_best(), "two_lux_parking");
}

// Simulated LUX have half a degree whatever the car: that alone makes them no other car's.
TEST(CaptureIdentity, ASimulatedDriveIsOfItsVehicle) {
  EXPECT_EQ(of_drive(parking()).words(parking()), "");
}

TEST(CaptureIdentity, ARecordingOfAnotherVehicleIsNamed) {
  const std::string of_parking = of_parking_lot().words(reference());
  EXPECT_EQ(of_parking.find("the packets look like those of two_lux_parking: "), 0U) << of_parking;
  EXPECT_NE(of_parking.find("directions on UDP port 12002 are 0.25 degrees apart, not 0.50"),
            std::string::npos)
      << of_parking;
  EXPECT_NE(of_parking.find("no scan comes to UDP port 12005"), std::string::npos);
  const std::string of_reference = of_drive(reference()).words(parking());
  EXPECT_EQ(of_reference.find("the packets look like those of reference_car: "), 0U);
  EXPECT_NE(of_reference.find("scans come to UDP port 12004"), std::string::npos);
}

// Two of its four sensors are silent, but those that speak are its own.
TEST(CaptureIdentity, AVehicleWithSilentSensorsIsNoOther) {
  CaptureIdentity identity;
  for (const std::uint16_t port : {std::uint16_t{12002}, std::uint16_t{12003}}) {
    add_scan(identity, port, scan(1, 201, 16));
  }
  EXPECT_EQ(identity.better_than(reference()), nullptr) << identity.words(reference());
  EXPECT_EQ(identity.words_of_wrong_port(reference()), "");
  add_scan(identity, 12014, scan(1, 201, 16));
  EXPECT_EQ(identity.words_of_wrong_port(reference()),
            "no packet comes to UDP port 12004, 12005, but scans come to 12014: check udp_port in "
            "the car file");
}

TEST(CaptureIdentity, WithoutAScanItSaysNothing) {
  CaptureIdentity identity;
  EXPECT_EQ(identity.words(reference()), "");
  EXPECT_EQ(identity.words_of_best(), "");
  add_scan(identity, 12002, std::vector<std::byte>(100));
  add_scan(identity, 5000, scan(1, 10, 16));
  EXPECT_EQ(identity.words(reference()), "");
  EXPECT_EQ(identity.words_of_best(), "no car that iog knows: UDP port 5000 receives an ibeo LUX");
}

}  // namespace
}  // namespace iog::tools
