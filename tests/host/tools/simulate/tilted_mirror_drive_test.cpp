// A simulated drive of a unit with eight layers: what its packets say, placed by SICK's formula and
// not by the product's tables, lies on the ground.
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>

#include "lidar/ibeo_lux8.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

const double kDegree = std::acos(-1.0) / 180;

// libsick_ldmrs, LuxBase::getVAngleOfLayer, as an elevation.
double elevation_of(std::size_t layer, double tilt, double azimuth) {
  const double side = layer < 4 ? 1.0 : -1.0;
  return (static_cast<double>(layer % 4) - 1.5) * 0.8 * kDegree +
         side * tilt * std::sqrt(2.0) * std::sin(azimuth / 2 - 45 * kDegree);
}

TEST(TiltedMirrorDrive, ScansAreOfOneSideInTurns) {
  const CatalogueEntry& car = find_vehicle("roof_ld_mrs");
  Drive drive(car, 1, 1);
  for (std::uint32_t frame = 0; frame < 6; ++frame) {
    std::set<int> layers;
    for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
      lidar::IbeoLux8 packet;
      ASSERT_EQ(packet.decode(datagram.payload), lidar::DecodeStatus::kOk);
      EXPECT_EQ(packet.info().scan_number, frame + 1);
      // Two sides a turn of the mirror, 12.5 turns a second; a beam goes twice as fast as it.
      EXPECT_NEAR(static_cast<double>(packet.info().sweep.end_us - packet.info().sweep.begin_us),
                  1e6 / 25 * 100 / 360, 2);
      packet.for_each_point([&](const lidar::ScanPoint& point) { layers.insert(point.layer); });
    }
    EXPECT_EQ(layers, frame % 2 == 0 ? (std::set{4, 5, 6, 7}) : (std::set{0, 1, 2, 3})) << frame;
  }
}

// A side or a sign gone wrong puts the ground 20 m away 1 m up or down. Where a beam meets ground
// with one edge and a thing with the other, the echo is between the two.
TEST(TiltedMirrorDrive, TheGroundIsLevel) {
  const CatalogueEntry& car = find_vehicle("roof_ld_mrs");
  const description::MountConfig& mount = car.sensors[0].mount;
  const double tilt = car.sensors[0].beam_tilt_deg * kDegree;
  const double pitch = mount.pitch_deg * kDegree;
  Drive drive(car, 1, 1);
  int points = 0;
  int level = 0;
  for (std::uint32_t frame = 0; frame < 10; ++frame) {
    for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
      lidar::IbeoLux8 packet;
      ASSERT_EQ(packet.decode(datagram.payload), lidar::DecodeStatus::kOk);
      packet.for_each_point([&](const lidar::ScanPoint& point) {
        if (!point.is_ground) {
          return;
        }
        const double azimuth = std::remainder(point.azimuth_ticks, 11520) * kDegree / 32;
        const double elevation = elevation_of(point.layer, tilt, azimuth);
        const double range_m = point.range_mm / 1000.0;
        const double forward = range_m * std::cos(elevation) * std::cos(azimuth);
        const double up = range_m * std::sin(elevation);
        const double on_car = mount.z_m + up * std::cos(pitch) - forward * std::sin(pitch);
        const double ahead = mount.x_m + up * std::sin(pitch) + forward * std::cos(pitch);
        // The car nods.
        const double z = on_car * drive.ego(frame).pitch_cos - ahead * drive.ego(frame).pitch_sin;
        ++points;
        level += std::abs(z) < 0.02 ? 1 : 0;
      });
    }
  }
  EXPECT_GT(points, 500);
  EXPECT_GT(level, points * 9 / 10);
}

}  // namespace
}  // namespace iog::tools
