// Units that turn on a car that drives: what each beam measures is where it was then, and what is
// said to be true of it is of that beam. Where a point is, is computed here from azimuth, range and
// mount.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/turning_units.hpp"
#include "intake/measurement_time.hpp"
#include "intake/packet.hpp"
#include "lidar/formats.hpp"
#include "stream/crc32.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/vehicles/packet_points.hpp"

namespace iog::tools {
namespace {

using tests::kTurningUnits;
using tests::TurningUnit;

constexpr double kDegree = std::numbers::pi / 180;

// A road that turns right by 0.4 rad/s at 10 m/s towards a long wall across.
constexpr Course kCurve{.radians_per_metre = -0.04, .swings = {{{0, 100}, {0, 100}}}};
constexpr Cruise kSteady{
    .mean_speed = 10, .speed_swing = 0, .swing_period = 10, .left = 0, .weave = 0};
constexpr double kWallX = 32;

Scene wall_ahead() {
  Landscape landscape;
  std::vector<Solid> solids{box(Material::kWall, {.x = kWallX + 1, .y = -10}, 2, 120, 0, 8)};
  landscape.place(0, solids);
  landscape.sort();
  return {Road(kCurve, 0, 100), kSteady, std::move(landscape), {}};
}

// Above the horizon. What else its calibration says of a laser its decoder has put right.
double elevation_of(const description::SensorConfig& sensor, std::size_t layer) {
  double elevation_deg = 0;
  if (!sensor.lasers.empty()) {
    elevation_deg = sensor.lasers[layer].elevation_deg;
  } else {
    lidar::with_decoder(sensor.format, [&]<typename Decoder>(std::type_identity<Decoder>) {
      elevation_deg = Decoder::kElevationsDeg.at(layer);
    });
  }
  return elevation_deg * kDegree;
}

// Where a laser's beam starts over the unit's origin; the decoder leaves it aside.
double over_origin(const description::SensorConfig& sensor, std::size_t layer) {
  return sensor.lasers.empty()
             ? 0
             : sensor.lasers[layer].height_m / std::cos(elevation_of(sensor, layer));
}

struct Seen {
  double x;      // in the world
  double share;  // of the turn, when it was measured
};

// The points of nearly level beams of some turns, placed from the pose of each packet's time, and
// of each turn's end.
struct Placed {
  std::vector<Seen> by_packet;
  std::vector<Seen> by_turn;
};

Placed placed_by(const std::string& car_name) {
  const CatalogueEntry& car = find_vehicle(car_name);
  const description::SensorConfig& sensor = car.sensors[0];
  const vehicle::Sensor& decoding = car.vehicle->sensors[0];
  const std::int32_t turn = lidar::ticks_per_turn(sensor.format);
  Drive drive(car, 1, 1, wall_ahead(), Motion::kContinuous);
  Placed placed;
  for (std::uint32_t frame = 3; frame < 6; ++frame) {
    const Placement at_end = drive.scene().ego_at((frame + 1) / 10.0).at;
    for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
      const auto packet = intake::Packet::decode(sensor.format, datagram.payload, decoding.unit());
      const std::uint64_t measured_us =
          intake::measured_us(decoding, packet.info(), datagram.time_us);
      const double time_s = static_cast<double>(measured_us - kDriveStartUs) / 1e6;
      const Placement then = drive.scene().ego_at(time_s).at;
      for (const lidar::ScanPoint& point : points_of(packet)) {
        const double elevation = elevation_of(sensor, point.layer);
        if (point.range_mm == 0 || std::abs(elevation) > 2.5 * kDegree) {
          continue;
        }
        const double azimuth =
            point.azimuth_ticks * 2 * std::numbers::pi / turn + sensor.mount.yaw_deg * kDegree;
        const double range_m = point.range_mm / 1000.0 * std::cos(elevation);
        const double x = sensor.mount.x_m + range_m * std::cos(azimuth);
        const double y = sensor.mount.y_m + range_m * std::sin(azimuth);
        placed.by_packet.push_back({moved(then, x, y).x, time_s * 10 - frame});
        placed.by_turn.push_back({moved(at_end, x, y).x, time_s * 10 - frame});
      }
    }
  }
  return placed;
}

// Of all cars: to make their drives takes longer than to look at them, so each is made once.
const std::map<std::string, Placed>& placed_of_all() {
  static const std::map<std::string, Placed> all_placed = [] {
    std::map<std::string, Placed> placed;
    for (const TurningUnit& unit : kTurningUnits) {
      placed.emplace(unit.car, placed_by(unit.car));
    }
    return placed;
  }();
  return all_placed;
}

// Mean distance from the wall's face of the points in a part of the turn.
double off_wall(const std::vector<Seen>& seen, double from_share, double to_share, double within) {
  double sum = 0;
  double count = 0;
  for (const Seen& point : seen) {
    if (point.share >= from_share && point.share < to_share &&
        std::abs(point.x - kWallX) < within) {
      sum += point.x - kWallX;
      ++count;
    }
  }
  EXPECT_GT(count, 100);
  return sum / count;
}

// The head looks forward when a turn begins and when it ends, an Ouster's backward.
TEST(MovingUnitsOfAllCars, AWallIsStraightFromTheCarsPoseOfEachPacket) {
  for (const auto& [car, placed] : placed_of_all()) {
    const bool is_ouster = car.starts_with("roof_os");
    const std::vector<Seen>& seen = placed.by_packet;
    for (const double share : is_ouster ? std::vector{0.4, 0.5} : std::vector{0.0, 0.9}) {
      EXPECT_NEAR(off_wall(seen, share, share + 0.1, 0.5), 0, 0.025) << car << " " << share;
    }
  }
}

TEST(MovingUnitsOfAllCars, AWallIsBentFromOnePoseOfTheTurn) {
  for (const auto& [car, placed] : placed_of_all()) {
    const std::vector<Seen>& seen = placed.by_turn;
    // What was measured a whole turn before its end is up to a metre farther ahead from there; an
    // Ouster looks forward in the middle of its turn.
    const double share = car.starts_with("roof_os") ? 0.4 : 0.0;
    EXPECT_GT(std::abs(off_wall(seen, share, share + 0.05, 2)), 0.25) << car;
  }
}

// A beam that nothing came back to has no truth, and each other has its own.
TEST(MovingUnits, EveryPointHasItsTruth) {
  std::vector<std::string> cars{"reference_car", "roof_ld_mrs"};
  for (const TurningUnit& unit : kTurningUnits) {
    cars.emplace_back(unit.car);
  }
  for (const std::string& name : cars) {
    const CatalogueEntry& car = find_vehicle(name);
    Drive drive(car, 3, 1, find_scene("city"), Motion::kContinuous);
    std::map<PointClass, int> counts;
    for (const SimulatedPacket& packet : drive.packets(1)) {
      const std::size_t sensor = sensor_of_port(car, packet.datagram.destination.port);
      const vehicle::Sensor& decoding = car.vehicle->sensors[sensor];
      const description::SensorConfig& config = car.sensors[sensor];
      std::size_t number = 0;
      const auto decoded =
          intake::Packet::decode(decoding.format, packet.datagram.payload, decoding.unit());
      for (const lidar::ScanPoint& point : points_of(decoded)) {
        ASSERT_LT(number, packet.points.size());
        const PointTruth& truth = packet.points[number++];
        ++counts[truth.what];
        EXPECT_EQ(truth.what == PointClass::kNothing, point.range_mm == 0) << name;
        EXPECT_EQ(truth.what == PointClass::kClutter, point.is_rain || point.is_dirt) << name;
        EXPECT_TRUE(!point.is_ground || truth.what == PointClass::kGround) << name;
        EXPECT_EQ(truth.what == PointClass::kMoving,
                  truth.what == PointClass::kMoving && truth.thing >= kFirstMover);
        if (truth.what == PointClass::kGround) {
          EXPECT_EQ(truth.height_m, 0) << name;
        }
        // Nearer than 20 m the height is what elevation and range say: the car nods by 0.2
        // degrees.
        if (name == "roof_hdl32e" && point.range_mm > 0 && point.range_mm < 20'000) {
          const double elevation = elevation_of(config, point.layer);
          const double height = config.mount.z_m + point.range_mm / 1000.0 * std::sin(elevation);
          EXPECT_NEAR(truth.height_m, height, 0.2) << name;
        }
      }
      EXPECT_EQ(number, packet.points.size()) << name;
    }
    EXPECT_GT(counts[PointClass::kGround], 20) << name;
    EXPECT_GT(counts[PointClass::kInfrastructure], 100) << name;
    EXPECT_GT(counts[PointClass::kMovable], 20) << name;
    EXPECT_GT(counts[PointClass::kMoving], 20) << name;
  }
}

// Where a frame has a point that another has there, in which the first one's origin is and by which
// it is turned: by roll, pitch and yaw, each about its axis.
Vector3 turned(const Vector3& point, double yaw, double pitch, double roll, const Vector3& origin) {
  const double y = point.y * std::cos(roll) - point.z * std::sin(roll);
  const double z = point.y * std::sin(roll) + point.z * std::cos(roll);
  const double x = point.x * std::cos(pitch) + z * std::sin(pitch);
  return {origin.x + x * std::cos(yaw) - y * std::sin(yaw),
          origin.y + x * std::sin(yaw) + y * std::cos(yaw),
          origin.z - point.x * std::sin(pitch) + z * std::cos(pitch)};
}

Vector3 place_of(const lidar::ScanPoint& point, const description::SensorConfig& sensor,
                 const EgoPose& ego) {
  const double elevation = elevation_of(sensor, point.layer);
  const double azimuth =
      point.azimuth_ticks * 2 * std::numbers::pi / lidar::ticks_per_turn(sensor.format);
  const double range_m = point.range_mm / 1000.0;
  const Vector3 seen{range_m * std::cos(elevation) * std::cos(azimuth),
                     range_m * std::cos(elevation) * std::sin(azimuth),
                     range_m * std::sin(elevation) + over_origin(sensor, point.layer)};
  const description::MountConfig& mount = sensor.mount;
  const Vector3 on_car = turned(seen, mount.yaw_deg * kDegree, mount.pitch_deg * kDegree,
                                mount.roll_deg * kDegree, {mount.x_m, mount.y_m, mount.z_m});
  return turned(on_car, std::atan2(ego.at.sin, ego.at.cos),
                std::atan2(ego.pitch_sin, ego.pitch_cos), std::atan2(ego.roll_sin, ego.roll_cos),
                {ego.at.x, ego.at.y, ego.z});
}

// Drives share the ground, which is computed where one of them asks for it.
Drive leaning_drive_over_hills(const std::string& car) {
  static const Scene hills = [] {
    Scene scene = find_scene("hills").make(1, 2);
    scene.attitude.emplace(1);
    return scene;
  }();
  return Drive(find_vehicle(car), 1, 2, hills, Motion::kContinuous);
}

// What a packet says, placed by mount and pose, is where its truth says: but for the error of a
// range and what the car does within a packet. The car climbs by 5 degrees.
TEST(MovingUnitsOfAllCars, APointIsWhereItsTruthSays) {
  for (const TurningUnit& unit : kTurningUnits) {
    const std::string name = unit.car;
    const description::SensorConfig& sensor = find_vehicle(name).sensors[0];
    const vehicle::Sensor& decoding = find_vehicle(name).vehicle->sensors[0];
    Drive drive = leaning_drive_over_hills(name);
    EXPECT_LT(drive.ego(19).pitch_sin, -0.08);
    double square_sum = 0;
    double count = 0;
    for (const SimulatedPacket& simulated : drive.packets(19)) {
      const auto packet =
          intake::Packet::decode(sensor.format, simulated.datagram.payload, decoding.unit());
      const std::uint64_t measured_us =
          intake::measured_us(decoding, packet.info(), simulated.datagram.time_us);
      const EgoPose ego =
          drive.scene().ego_at(static_cast<double>(measured_us - kDriveStartUs) / 1e6);
      auto next = simulated.points.begin();
      for (const lidar::ScanPoint& point : points_of(packet)) {
        const PointTruth& truth = *next++;
        if (point.range_mm == 0) {
          continue;
        }
        const Vector3 placed = place_of(point, sensor, ego);
        const double off =
            std::hypot(placed.x - truth.at.x, placed.y - truth.at.y, placed.z - truth.at.z);
        EXPECT_LT(off, 0.4) << name;
        EXPECT_NEAR(truth.height_m, truth.at.z - drive.scene().ground_at(truth.at.x, truth.at.y),
                    1e-6)
            << name;
        square_sum += off * off;
        ++count;
      }
    }
    EXPECT_GT(count, 5'000) << name;
    EXPECT_LT(std::sqrt(square_sum / count), 0.08) << name;
  }
}

// Every compiler and machine must get these bytes; whoever changes the world on purpose pins anew.
TEST(MovingUnitsOfAllCars, BytesArePinned) {
  for (const TurningUnit& unit : kTurningUnits) {
    stream::Crc32 crc;
    for (const CapturedDatagram& datagram : leaning_drive_over_hills(unit.car).datagrams(5)) {
      crc.update(datagram.payload);
    }
    EXPECT_EQ(crc.value(), unit.moving_drive_crc) << unit.car;
  }
}

// Three LUX and two that turn: everything comes in order, and each at its own rate.
TEST(MovingUnits, AMixedCarMoves) {
  const CatalogueEntry& lux = find_vehicle("reference_car");
  const CatalogueEntry& turning = find_vehicle("roof_vlp16");
  std::vector<description::SensorConfig> configs(lux.sensors.begin(), lux.sensors.end());
  configs.insert(configs.end(), turning.sensors.begin(), turning.sensors.end());
  const CatalogueEntry mixed{lux.vehicle, lux.description, configs, lux.network};
  Drive drive(mixed, 5, 2, find_scene("city"), Motion::kContinuous);
  ASSERT_EQ(drive.frame_count(), 50U);
  std::map<std::uint16_t, std::size_t> counts;
  std::uint64_t last_us = 0;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
      EXPECT_GE(datagram.time_us, last_us);
      last_us = datagram.time_us;
      ++counts[datagram.destination.port];
    }
  }
  EXPECT_EQ(counts.size(), 5U);
  EXPECT_NEAR(static_cast<double>(counts[2368]), 2 * 753.5, 2);
}

}  // namespace
}  // namespace iog::tools
