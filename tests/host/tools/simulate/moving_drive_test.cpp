// A drive in which the car moves while its scanners sweep. Whether a point is where it should be is
// computed here from the mounts of the vehicle's description, with the C library's trigonometry.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "stream/crc32.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/formats/lux/ntp_time.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/simulate/drives/drive.hpp"

namespace iog::tools {
namespace {

constexpr double kPeriodUs = 40'000;

const CatalogueEntry& reference_car() { return find_vehicle("reference_car"); }

Drive moving_drive(std::uint64_t seed, const SceneEntry& scene = find_scene(kDefaultScene)) {
  return Drive(reference_car(), seed, 1, scene, Motion::kContinuous);
}

std::vector<CapturedDatagram> sample(std::uint64_t seed, std::uint32_t frames,
                                     std::string_view scene) {
  Drive drive = moving_drive(seed, find_scene(scene));
  std::vector<CapturedDatagram> datagrams;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    for (CapturedDatagram& datagram : drive.datagrams(frame)) {
      datagrams.push_back(std::move(datagram));
    }
  }
  return datagrams;
}

std::uint32_t crc_of(const std::vector<CapturedDatagram>& datagrams) {
  stream::Crc32 crc;
  for (const CapturedDatagram& datagram : datagrams) {
    crc.update(datagram.payload);
  }
  return crc.value();
}

TEST(MovingDrive, SameSeedSameBytes) {
  for (const std::string_view scene : {"city", "ring_road", "street"}) {
    const std::uint32_t once = crc_of(sample(1, 3, scene));
    EXPECT_EQ(once, crc_of(sample(1, 3, scene)));
    EXPECT_NE(once, crc_of(sample(2, 3, scene)));
  }
}

// Every compiler and machine must get these bytes; whoever changes the world on purpose pins anew.
TEST(MovingDrive, BytesArePinned) {
  EXPECT_EQ(crc_of(sample(1, 10, "city")), 0x4C3FF184U);
  EXPECT_EQ(crc_of(sample(1, 10, "street")), 0x271518ECU);
  EXPECT_EQ(crc_of(sample(1, 10, "hills")), 0x91C484D3U);
}

TEST(MovingDrive, EveryScannerHasItsPhase) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const Drive drive = moving_drive(seed);
    std::set<std::uint64_t> phases;
    for (std::size_t sensor = 0; sensor < 4; ++sensor) {
      phases.insert(drive.scan_end_us(sensor, 0));
      EXPECT_EQ(drive.scan_end_us(sensor, 7), drive.scan_end_us(sensor, 0) + 280'000);
      EXPECT_GE(drive.scan_end_us(sensor, 0), 40'000U);
      EXPECT_LE(drive.scan_end_us(sensor, 0), drive.frame_end_us(0));
    }
    std::uint64_t last = 0;
    for (const std::uint64_t phase : phases) {
      EXPECT_GT(phase - last, kPeriodUs / 20 / 4);
      last = phase;
    }
    EXPECT_EQ(phases.size(), 4U);
    EXPECT_LT(last, 80'000U);
  }
}

TEST(MovingDrive, PhasesDependOnTheSeed) {
  EXPECT_NE(moving_drive(1).scan_end_us(0, 0), moving_drive(2).scan_end_us(0, 0));
}

TEST(MovingDrive, PacketsLeaveInOrderAfterTheirScan) {
  std::uint64_t last_us = 0;
  for (const CapturedDatagram& datagram : sample(5, 5, "city")) {
    const LuxScan scan = parse_lux_message(datagram.payload);
    const std::uint64_t end_us = unix_us_of_ntp(scan.end_ntp);
    EXPECT_NEAR(static_cast<double>(end_us - unix_us_of_ntp(scan.start_ntp)), 11'111, 1);
    EXPECT_GE(datagram.time_us, end_us);
    EXPECT_LT(datagram.time_us - end_us, 1'000U);
    EXPECT_GE(datagram.time_us, last_us);
    last_us = datagram.time_us;
  }
}

// However the phases lie, the scans of a frame come within one period: the target waits no longer.
TEST(MovingDrive, EveryFrameIsComplete) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    std::uint64_t complete = 0;
    FrameAssembler assembler([&](const GridFrame& frame) {
      complete += frame.header.complete_sensors == 0xF ? 1U : 0U;
    });
    for (const auto& message : messages_of(reference_car(), sample(seed, 5, "city"))) {
      assembler.take(message);
    }
    EXPECT_EQ(complete, 5U) << "seed " << seed;
  }
}

struct WorldPoint {
  double x;
  double y;
  double share;  // of the sweep, when it was measured
};

// Where a point of a scan is, if the car stood there. Pitch moves it by less than a millimetre.
WorldPoint placed(const description::MountConfig& mount, const LuxPoint& point,
                  const Placement& car, double share) {
  const double range = point.range_cm / 100.0;
  const double azimuth = (point.angle_ticks / 32.0 + mount.yaw_deg) * std::numbers::pi / 180;
  const double elevation = (point.layer - 1.5) * 0.8 * std::numbers::pi / 180;
  const double x = mount.x_m + range * std::cos(elevation) * std::cos(azimuth);
  const double y = mount.y_m + range * std::cos(elevation) * std::sin(azimuth);
  return {car.x + x * car.cos - y * car.sin, car.y + x * car.sin + y * car.cos, share};
}

enum class Pose : std::uint8_t { kOfPoint, kOfScanEnd };

// All first echoes of a frame that are not flagged, in the world.
std::vector<WorldPoint> world_points(Drive& drive, std::uint32_t frame, Pose pose) {
  std::vector<WorldPoint> points;
  for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
    const std::size_t sensor = sensor_of_port(reference_car(), datagram.destination.port);
    const double end_us = static_cast<double>(drive.scan_end_us(sensor, frame));
    for (const LuxPoint& point : parse_lux_message(datagram.payload).points) {
      if (point.echo == 0 && point.flags == 0) {
        const double share = (1600 - point.angle_ticks) / 3200.0;
        const double time_us = pose == Pose::kOfPoint ? end_us - (1 - share) * 11'111 : end_us;
        points.push_back(placed(reference_car().sensors[sensor].mount, point,
                                drive.scene().ego_at(time_us / 1e6).at, share));
      }
    }
  }
  return points;
}

// The world for the laws below: a road that turns right by 0.4 rad/s at 10 m/s.
constexpr Course kCurve{.radians_per_metre = -0.04, .swings = {{{0, 100}, {0, 100}}}};
constexpr Cruise kSteady{
    .mean_speed = 10, .speed_swing = 0, .swing_period = 10, .left = 0, .weave = 0};
constexpr double kWallX = 32;  // where its face is

Scene make_wall(std::uint64_t /*seed*/, double /*drive_s*/) {
  Landscape landscape;
  std::vector<Solid> solids{box(Material::kWall, {.x = kWallX + 1, .y = -10}, 2, 120, 0, 8)};
  landscape.place(0, solids);
  landscape.sort();
  return {Road(kCurve, 0, 100), kSteady, std::move(landscape), {}};
}

// Mean distance from the wall's face, and their standard deviation, of the points that were
// measured in one part of the sweep.
struct Residuals {
  double mean = 0;
  double sigma = 0;
  double count = 0;
};

Residuals from_wall(Pose pose, double first_share, double last_share) {
  Drive drive = moving_drive(1, {"wall", make_wall});
  double sum = 0;
  double squares = 0;
  double count = 0;
  for (std::uint32_t frame = 5; frame < 20; ++frame) {
    for (const WorldPoint& point : world_points(drive, frame, pose)) {
      const double off = point.x - kWallX;
      if (std::abs(off) < 1 && point.share >= first_share && point.share <= last_share) {
        sum += off;
        squares += off * off;
        ++count;
      }
    }
  }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean), count};
}

// The range is precise to 7 cm (one standard deviation) and rounded to 1 cm; the beam is at most
// that oblique to the wall.
TEST(MovingDrive, AWallIsStraightFromTheCarsPoseOfEachPoint) {
  for (const double share : {0.0, 0.25, 0.5, 0.75}) {
    const Residuals all = from_wall(Pose::kOfPoint, share, share + 0.25);
    ASSERT_GT(all.count, 1000);
    EXPECT_NEAR(all.mean, 0, 4 * 0.07 / std::sqrt(all.count)) << share;
    EXPECT_LT(all.sigma, 0.075);
  }
}

// What was measured 11 ms before the end is 11 cm nearer than it seems from there, and 4 mrad
// beside.
TEST(MovingDrive, AWallIsBentFromOnePoseOfTheScan) {
  EXPECT_GT(std::abs(from_wall(Pose::kOfScanEnd, 0, 0.25).mean), 0.06);
  EXPECT_LT(std::abs(from_wall(Pose::kOfScanEnd, 0.9, 1).mean), 0.02);
}

// A lorry that crosses at 20 m/s from right to left, 25 m ahead of a car that nearly stands.
constexpr double kLorrySpeed = 20;
constexpr double kLorryAhead = 25;

Scene make_crossing(std::uint64_t /*seed*/, double /*drive_s*/) {
  constexpr Course kStraight{.swings = {{{0, 100}, {0, 100}}}};
  constexpr Cruise kCreep{
      .mean_speed = 0.001, .speed_swing = 0, .swing_period = 10, .left = 0, .weave = 0};
  Traffic traffic;
  traffic.crossers.push_back({.junction = kLorryAhead,
                              .passes_s = 0.5,
                              .left = 0,
                              .speed = kLorrySpeed,
                              .side = 1,
                              .shape = kLorry});
  Landscape landscape;
  landscape.sort();
  return {Road(kStraight, 0, 100), kCreep, std::move(landscape), std::move(traffic)};
}

// Its front and rear corners, seen at different times of a sweep, are where they were then.
TEST(MovingDrive, AThingIsSeenWhereItIsAtEachPointsTime) {
  Drive drive = moving_drive(3, {"crossing", make_crossing});
  std::size_t seen = 0;
  for (std::uint32_t frame = 2; frame < 20; ++frame) {
    for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
      const std::size_t sensor = sensor_of_port(reference_car(), datagram.destination.port);
      for (const LuxPoint& point : parse_lux_message(datagram.payload).points) {
        const double share = (1600 - point.angle_ticks) / 3200.0;
        const double time_s =
            (static_cast<double>(drive.scan_end_us(sensor, frame)) - (1 - share) * 11'111) / 1e6;
        const WorldPoint at = placed(reference_car().sensors[sensor].mount, point,
                                     drive.scene().ego_at(time_s).at, share);
        if (point.flags != 0 || std::abs(at.x - (kLorryAhead - 1.25)) > 0.5) {
          continue;
        }
        // Half the beam's width at its edge, and the range's error along an oblique beam.
        const double middle = (time_s - 0.5) * kLorrySpeed;
        EXPECT_LT(std::abs(at.y - middle), 16.5 / 2 + 0.15) << "frame " << frame;
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 2000U);
}

}  // namespace
}  // namespace iog::tools
