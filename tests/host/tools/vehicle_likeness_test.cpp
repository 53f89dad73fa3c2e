// Vehicles that share UDP ports are told apart by what their sensors send.
#include "tools/vehicles/vehicle_likeness.hpp"

#include <gtest/gtest.h>

#include "drive_sample.hpp"
#include "fakes/lux_message.hpp"

namespace iog::tools {
namespace {

const CatalogueEntry& reference() { return find_vehicle("reference_car"); }
const CatalogueEntry& parking() { return find_vehicle("two_lux_parking"); }

VehicleLikeness of_drive(const CatalogueEntry& car) {
  VehicleLikeness likeness;
  for (const CapturedDatagram& datagram : sample_drive(car, 1, 1)) {
    likeness.add(datagram);
  }
  return likeness;
}

// A scan of so many directions, so many ticks apart.
std::vector<std::byte> scan(int directions, int step_ticks) {
  tests::LuxMessage message{.points = {}};
  for (int i = 0; i < directions; ++i) {
    message.points.push_back({.angle_ticks = 1600 - i * step_ticks, .range_cm = 2000});
  }
  return message.bytes();
}

void add_scan(VehicleLikeness& likeness, std::uint16_t port, const std::vector<std::byte>& bytes) {
  likeness.add({.source = {}, .destination = {.port = port}, .payload = bytes});
}

// Two LUX of a quarter of a degree, as the recording of the parking lot has them.
VehicleLikeness of_parking_lot() {
  VehicleLikeness likeness;
  for (const std::uint16_t port : {std::uint16_t{12002}, std::uint16_t{12003}}) {
    add_scan(likeness, port, scan(401, 8));
  }
  return likeness;
}

TEST(VehicleLikeness, EachVehiclesOwnScansAreItsOwn) {
  const VehicleLikeness drive = of_drive(reference());
  EXPECT_TRUE(drive.misfits(reference()).empty());
  EXPECT_EQ(drive.words(reference()), "");
  EXPECT_EQ(drive.words_of_best(), "reference_car");
  const VehicleLikeness lot = of_parking_lot();
  EXPECT_TRUE(lot.misfits(parking()).empty());
  EXPECT_EQ(lot.words(parking()), "");
  EXPECT_EQ(lot.words_of_best(), "two_lux_parking");
}

// Simulated LUX have half a degree whatever the car: that alone makes them no other car's.
TEST(VehicleLikeness, ASimulatedDriveIsOfItsVehicle) {
  EXPECT_EQ(of_drive(parking()).words(parking()), "");
}

TEST(VehicleLikeness, ARecordingOfAnotherVehicleIsNamed) {
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
TEST(VehicleLikeness, AVehicleWithSilentSensorsIsNoOther) {
  VehicleLikeness likeness;
  for (const std::uint16_t port : {std::uint16_t{12002}, std::uint16_t{12003}}) {
    add_scan(likeness, port, scan(201, 16));
  }
  EXPECT_EQ(likeness.better_than(reference()), nullptr) << likeness.words(reference());
}

TEST(VehicleLikeness, WithoutAScanItSaysNothing) {
  VehicleLikeness likeness;
  EXPECT_EQ(likeness.words(reference()), "");
  EXPECT_EQ(likeness.words_of_best(), "");
  add_scan(likeness, 12002, std::vector<std::byte>(100));
  add_scan(likeness, 5000, scan(10, 16));
  EXPECT_EQ(likeness.words(reference()), "");
  EXPECT_EQ(likeness.words_of_best(), "");
}

}  // namespace
}  // namespace iog::tools
