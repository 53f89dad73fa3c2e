// Which sectors around the vehicle are not watched: 64 of 5.625 degrees, counter-clockwise from
// straight ahead.
#include "intake/watched_sectors.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <utility>
#include <vector>

#include "fakes/lux_message.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/velodyne_packet.hpp"
#include "lidar/formats.hpp"
#include "tools/car/mount.hpp"
#include "tools/car/tables.hpp"

namespace iog::intake {
namespace {

using tests::LuxMessage;
using tests::OneLux;

constexpr std::uint64_t kNobody = ~std::uint64_t{0};
constexpr double kSectorRad = 2 * std::numbers::pi / 64;

// Bits `first` to `last`, both included; beyond 63 they go on at 0.
std::uint64_t sectors(unsigned first, unsigned last) {
  std::uint64_t bits = 0;
  for (unsigned i = first; i <= last; ++i) {
    bits |= std::uint64_t{1} << i % 64;
  }
  return bits;
}

// A vehicle's intake and what it has watched, frame by frame.
class Watch {
 public:
  explicit Watch(const vehicle::Vehicle& vehicle)
      : intake_(vehicle.sensors, kReplayer), watched_(vehicle.sensors) {}

  void take(std::uint16_t port, const std::vector<std::byte>& bytes) {
    const auto packet = intake_.receive({kReplayer, port, bytes});
    ASSERT_TRUE(packet.has_value());
    ASSERT_EQ(intake_.classify(*packet), Intake::Outcome::kThisFrame);
    intake_.accept(*packet);
    watched_.add(packet->sensor, packet->packet);
  }
  void take_scan(std::uint16_t port, int left, int right, int points = 1) {
    LuxMessage message{
        .scan_number = ++scans_, .start_ticks = left, .end_ticks = right, .points = {}};
    message.points.assign(static_cast<std::size_t>(points),
                          {.angle_ticks = right + 5, .range_cm = 1000});
    take(port, message.bytes());
  }

  // Of a VLP-16, degrees clockwise from its front.
  void take_turn(std::uint16_t port, int from_deg, int to_deg) {
    constexpr int kStep = 40;
    for (int azimuth = 100 * from_deg; azimuth < 100 * to_deg; azimuth += 12 * kStep) {
      tests::VelodynePacket packet{.first_azimuth = azimuth, .step = kStep, .time_us = ++shots_};
      for (std::array<int, 32>& block : packet.ranges) {
        block.fill(2500 + static_cast<int>(shots_ % 100));
      }
      take(port, packet.bytes());
    }
  }

  [[nodiscard]] std::uint64_t unwatched(std::uint64_t now_us = 0) {
    return watched_.at_end(intake_, now_us).unwatched;
  }
  void end_frame(std::uint64_t now_us = 0) {
    watched_.end_frame(intake_, now_us);
    intake_.start_frame();
  }

 private:
  static constexpr std::uint32_t kReplayer = 0x0A000202;
  Intake intake_;
  WatchedSectors watched_;
  int scans_ = 0;
  std::uint32_t shots_ = 0;
};

TEST(WatchedSectors, BeforeAnythingComesNobodyWatches) {
  EXPECT_EQ(Watch(OneLux::kVehicle).unwatched(), kNobody);
}

// 3,200 of 11,520 ticks are 100 degrees, 50 to each side: 8 sectors, and 8/9 of a ninth.
TEST(WatchedSectors, AWholeScanWatchesItsFieldOfView) {
  Watch watch(OneLux::kVehicle);
  watch.take_scan(100, 1600, -1600);
  EXPECT_EQ(watch.unwatched(), ~sectors(55, 64 + 8));
}

// From 31.3 to 10.6 degrees to the left: all of sectors 2 to 4, half of sector 5, and a ninth of
// sector 1.
TEST(WatchedSectors, APacketThatIsLostLeavesItsSectorsUnwatched) {
  Watch watch(OneLux::kVehicle);
  watch.take_scan(100, 1600, 1000);
  LuxMessage rest{.scan_number = 1, .start_ticks = 340, .end_ticks = -1600, .points = {}};
  rest.points.assign(1, {.angle_ticks = 5, .range_cm = 1000});
  watch.take(100, rest.bytes());
  EXPECT_EQ(watch.unwatched(), ~(sectors(55, 64 + 1) | sectors(6, 8)));
}

TEST(WatchedSectors, OneWhoFallsSilentWatchesNothingInTheNextFrame) {
  Watch watch(OneLux::kVehicle);
  watch.take_scan(100, 1600, -1600);
  watch.end_frame();
  EXPECT_EQ(watch.unwatched(), kNobody);
}

TEST(WatchedSectors, OneWhoseWholeScanHasNoPointIsBlind) {
  Watch watch(OneLux::kVehicle);
  watch.take_scan(100, 1600, -1600, 0);
  EXPECT_EQ(watch.unwatched(), kNobody);
}

// Of two that look the same way and are turned by 12 degrees, one is enough where both look.
TEST(WatchedSectors, OneSensorIsEnough) {
  Watch both(tests::ThreeLux::kVehicle);
  both.take_scan(100, 1600, -1600);
  const std::uint64_t one = both.unwatched();
  both.take_scan(101, 1600, -1600);
  const std::uint64_t two = both.unwatched();
  EXPECT_EQ(one & two, two);
  EXPECT_NE(one, two);
  EXPECT_EQ(two & sectors(60, 64 + 3), 0U);
}

// In two frames, each of which has less than a turn; then for 200 ms.
TEST(WatchedSectors, AUnitThatTurnsWatchesForTheTimeOfATurn) {
  Watch watch(tests::LevelVlp16::kVehicle);
  watch.take_turn(100, 0, 170);
  watch.end_frame(1'000'000);
  EXPECT_NE(watch.unwatched(1'000'000), 0U);
  watch.take_turn(100, 170, 360);
  EXPECT_EQ(watch.unwatched(1'100'000), 0U);
  watch.end_frame(1'100'000);
  EXPECT_EQ(watch.unwatched(1'200'000), 0U);
  EXPECT_NE(watch.unwatched(1'200'001), 0U);
  EXPECT_NE(watch.unwatched(1'300'000), kNobody);
  EXPECT_EQ(watch.unwatched(1'300'001), kNobody);
}

// Where the mounts of the description say that the sensor sees the circle, in doubles.
void expect_view(const vehicle::Sensor& sensor, const description::SensorConfig& config) {
  const description::MountConfig& mount = config.mount;
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
  const double yaw = radians(mount.yaw_deg);
  const double pitch = radians(mount.pitch_deg);
  const double roll = radians(mount.roll_deg);
  // The first two columns of Rz(yaw) Ry(pitch) Rx(roll), on the plane.
  const double forward_x = std::cos(yaw) * std::cos(pitch);
  const double forward_y = std::sin(yaw) * std::cos(pitch);
  const double left_x =
      std::cos(yaw) * std::sin(pitch) * std::sin(roll) - std::sin(yaw) * std::cos(roll);
  const double left_y =
      std::sin(yaw) * std::sin(pitch) * std::sin(roll) + std::cos(yaw) * std::cos(roll);
  const double up = forward_x * left_y - forward_y * left_x;
  const double turn = sensor.azimuths.ticks_per_turn();
  const auto ticks_of = [&](double direction) {
    const double x = 20 * std::cos(direction) - mount.x_m;
    const double y = 20 * std::sin(direction) - mount.y_m;
    const double azimuth =
        std::atan2((forward_x * y - forward_y * x) / up, (x * left_y - y * left_x) / up);
    return azimuth / (2 * std::numbers::pi) * turn;
  };
  const SectorView view = view_of(sensor);
  for (std::size_t i = 0; i < kSectors; ++i) {
    double first = ticks_of(static_cast<double>(i) * kSectorRad);
    double last = ticks_of(static_cast<double>(i + 1) * kSectorRad);
    if (up < 0) {  // it counts clockwise
      std::swap(first, last);
    }
    EXPECT_NEAR(std::remainder(view.at(i).first_ticks - first, turn), 0, 1.5) << i;
    EXPECT_NEAR(std::remainder(view.at(i).width_ticks - (last - first), turn), 0, 2.5) << i;
  }
}

TEST(WatchedSectors, AreSeenWhereTheMountsSay) {
  expect_view(OneLux::kVehicle.sensors[0], OneLux::kConfigs[0]);
  expect_view(tests::TiltedLux::kVehicle.sensors[0], tests::TiltedLux::kConfigs[0]);
  expect_view(tests::ThreeLux::kVehicle.sensors[1], tests::ThreeLux::kConfigs[1]);
  expect_view(tests::MixedCar::kVehicle.sensors[1], tests::MixedCar::kConfigs[1]);
}

// Rolled over, its left is on the car's right.
TEST(WatchedSectors, OneThatHangsUpsideDownIsSeenWhereItsMountSays) {
  const description::SensorConfig hanging =
      tests::test_vlp16(100, {.x_m = 1.3, .y_m = 0.4, .z_m = 2, .yaw_deg = 31, .roll_deg = 178});
  expect_view(description::sensor_of(hanging, tests::LevelVlp16::kDescription), hanging);
}

// 70 m ahead of the vehicle, and looking at it.
TEST(WatchedSectors, OneWhoStandsOutsideOfTheCircleWatchesNoMoreThanItSees) {
  for (const lidar::Sector& sector : view_of(tests::ThreeLux::kVehicle.sensors[2])) {
    EXPECT_LT(sector.width_ticks, 11'520 / 2);
  }
}

}  // namespace
}  // namespace iog::intake
