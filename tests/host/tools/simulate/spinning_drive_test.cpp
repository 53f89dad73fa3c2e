// Simulated units that turn: their packets are such as the real ones send, and what they measured
// is where it is.
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "fakes/turning_units.hpp"
#include "intake/measurement_time.hpp"
#include "intake/packet.hpp"
#include "lidar/velodyne_identity.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/scanners/packet_encoder.hpp"
#include "tools/simulate/scanners/spinning_beams.hpp"
#include "tools/vehicles/packet_points.hpp"

namespace iog::tools {
namespace {

using tests::kTurningUnits;
using tests::TurningUnit;

constexpr std::uint32_t kMostTurns = 3;

// The first turns of a car's drive, of which every test gets the same ones.
std::vector<CapturedDatagram> turns_of(const std::string& car, std::uint32_t turns) {
  static std::map<std::string, std::vector<std::vector<CapturedDatagram>>> drives;
  auto& made = drives[car];
  if (made.empty()) {
    Drive drive(find_vehicle(car), 1, 1);
    for (std::uint32_t turn = 0; turn < kMostTurns; ++turn) {
      made.push_back(drive.datagrams(turn));
    }
  }
  std::vector<CapturedDatagram> datagrams;
  for (std::uint32_t turn = 0; turn < turns; ++turn) {
    datagrams.insert(datagrams.end(), made.at(turn).begin(), made.at(turn).end());
  }
  return datagrams;
}

// Both kinds of lists follow from one: formats, and cars with one unit that turns.
TEST(TurningUnits, EveryFormatAndEveryCarHasARow) {
  // The cars of vehicles/ have the newer of each two, and points turn as their units do.
  std::set<lidar::Format> formats{lidar::kFormat<lidar::OusterRng19>,
                                  lidar::kFormat<lidar::PointsTurning>,
                                  lidar::kFormat<lidar::VelodyneHdl64eS2>};
  std::set<std::string_view> cars;
  for (const TurningUnit& unit : kTurningUnits) {
    formats.insert(find_vehicle(unit.car).sensors[0].format);
    cars.insert(unit.car);
  }
  lidar::for_each_format([&](lidar::Format format, auto /*decoder*/) {
    EXPECT_EQ(formats.contains(format), lidar::turns(format)) << lidar::name_of(format);
  });
  for (const CatalogueEntry& car : all_vehicles()) {
    const bool has_one = car.sensors.size() == 1 && lidar::turns(car.sensors[0].format);
    EXPECT_EQ(cars.contains(car.vehicle->name), has_one) << car.vehicle->name;
  }
}

TEST(SpinningDrive, SendsAsManyPacketsAsTheUnitDoes) {
  for (const TurningUnit& unit : kTurningUnits) {
    const auto datagrams = turns_of(unit.car, 2);
    EXPECT_NEAR(static_cast<double>(datagrams.size()), unit.packets_per_second / 5, 1) << unit.car;
    for (std::size_t i = 1; i < datagrams.size(); ++i) {
      const double apart_us = static_cast<double>(datagrams[i].time_us - datagrams[i - 1].time_us);
      ASSERT_NEAR(apart_us, 1e6 / unit.packets_per_second, 1) << unit.car;
    }
  }
}

// Each packet lasts until the next, and is sent when it is full.
TEST(SpinningDrive, SaysWhenItsPacketsWereMeasured) {
  for (const TurningUnit& unit : kTurningUnits) {
    const vehicle::Sensor& sensor = find_vehicle(unit.car).vehicle->sensors[0];
    const double packet_us = 1e6 / unit.packets_per_second;
    for (const CapturedDatagram& datagram : turns_of(unit.car, 1)) {
      const intake::Packet packet =
          intake::Packet::decode(sensor.format, datagram.payload, sensor.unit());
      ASSERT_TRUE(packet.is_sound()) << unit.car;
      const std::uint64_t measured_us =
          intake::measured_us(sensor, packet.info(), datagram.time_us);
      // The lasers of a Pandar64 fire before their block does.
      ASSERT_NEAR(static_cast<double>(datagram.time_us - measured_us), packet_us / 2, 60)
          << unit.car;
    }
  }
}

TEST(SpinningDrive, VelodynesPacketsAreKnownAsTheirUnits) {
  for (const TurningUnit& unit : kTurningUnits) {
    const CatalogueEntry& car = find_vehicle(unit.car);
    if (!lidar::name_of(car.sensors[0].format).starts_with("Velodyne")) {
      continue;
    }
    lidar::VelodyneIdentity identity;
    lidar::FormatSet possible;
    for (const CapturedDatagram& datagram : turns_of(unit.car, 1)) {
      possible = identity.add(datagram.payload);
    }
    EXPECT_EQ(possible, lidar::FormatSet(car.sensors[0].format)) << unit.car;
  }
}

TEST(SpinningDrive, TheSameSeedGivesTheSameBytes) {
  const auto bytes_of = [](std::uint64_t seed) {
    Drive drive(find_vehicle("roof_vlp16"), seed, 1);
    return drive.datagrams(3).at(40).payload;
  };
  EXPECT_EQ(bytes_of(1), bytes_of(1));
  EXPECT_NE(bytes_of(1), bytes_of(2));
}

// A street whose only ground is flat: the heights at which the low beams of a unit end, by what its
// description says of it. lasers of the calibration start where they start.
TEST(SpinningDrive, LowBeamsEndOnTheGround) {
  for (const TurningUnit& unit : kTurningUnits) {
    const CatalogueEntry& car = find_vehicle(unit.car);
    const description::SensorConfig& config = car.sensors[0];
    // Nothing but the ground, and the car stands level.
    const RayCaster rays(placed(frame_of(config.mount), {}), {}, kSpinningFarthest);
    Random random(5);
    std::vector<PointTruth> truth;
    const auto bytes = encoder_of(config)->packet(0, 0, rays, random, truth);
    const vehicle::Sensor& sensor = car.vehicle->sensors[0];
    const intake::Packet packet = intake::Packet::decode(config.format, bytes, sensor.unit());
    ASSERT_TRUE(packet.is_sound()) << unit.car;
    std::set<int> layers;
    for (const lidar::ScanPoint& point : points_of(packet)) {
      double elevation_deg = 0;
      double height_m = 0;
      if (config.lasers.empty()) {
        lidar::with_decoder(config.format, [&]<typename Decoder>(std::type_identity<Decoder>) {
          elevation_deg = Decoder::kElevationsDeg.at(point.layer);
        });
      } else {
        elevation_deg = config.lasers[point.layer].elevation_deg;
        height_m = config.lasers[point.layer].height_m;
      }
      if (point.range_mm == 0 || elevation_deg > -3) {
        continue;
      }
      const double elevation = elevation_deg * 3.14159265358979 / 180;
      const double start_m = config.mount.z_m + height_m / std::cos(elevation);
      const double end_m = start_m + std::sin(elevation) * point.range_mm / 1'000;
      // Four sigma of the range and what the wire rounds.
      ASSERT_NEAR(end_m, 0, -std::sin(elevation) * (4 * config.sigma_m + 0.004))
          << unit.car << " " << elevation_deg;
      layers.insert(point.layer);
    }
    EXPECT_GT(layers.size(), 5U) << unit.car;
  }
}

// What its own vehicle makes of it, in frames of a turn: whole frames; and what another makes of
// it: nothing.
TEST(SpinningDrive, IsFusedByItsVehicleAndByNoOther) {
  const auto count = [](const char* name, const std::vector<CapturedDatagram>& datagrams) {
    struct {
      unsigned complete = 0;
      std::uint32_t other_unit = 0;
      std::uint32_t dropped = 0;
    } found;
    FrameAssembler assembler([&](GridFrame&& frame) {
      found.complete += frame.end.sensors[0].state == intake::SensorState::kComplete ? 1U : 0U;
      found.other_unit =
          frame.end.packet_drops[static_cast<std::size_t>(intake::PacketDrop::kOtherUnit)];
      found.dropped = frame.header.packets_dropped;
    });
    CatalogueEntry car = find_vehicle(name);
    vehicle::Vehicle its = *car.vehicle;
    its.frame_period_us = 150'000;
    car.vehicle = &its;
    for (const auto& message : messages_of(car, datagrams)) {
      assembler.take(message);
    }
    assembler.finish();
    return found;
  };
  for (const TurningUnit& unit : kTurningUnits) {
    const auto datagrams = turns_of(unit.car, kMostTurns);
    const auto own = count(unit.car, datagrams);
    EXPECT_GE(own.complete, 2U) << unit.car;
    EXPECT_LE(own.other_unit, 3U) << unit.car;  // until it is known
    EXPECT_EQ(own.dropped, own.other_unit) << unit.car;
    for (const TurningUnit& other : kTurningUnits) {
      if (&other != &unit) {
        EXPECT_EQ(count(other.car, datagrams).complete, 0U) << unit.car << " as " << other.car;
      }
    }
  }
}

}  // namespace
}  // namespace iog::tools
