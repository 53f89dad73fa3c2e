// A missing return frees cells where the open sky is seen, and none where the unit is covered.
#include "app/frame.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>

#include "fakes/flat_scan.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/vlp16_scene.hpp"
#include "tools/car/tables.hpp"

namespace iog::app {
namespace {

using tests::covered;
using tests::field;

// A VLP-16 whose missing returns clear 20 m.
class Drive {
 public:
  void turn(const tests::Scene& scene) {
    now_us_ += 100'000;
    frame_->fusion().own().clear();
    for (const auto& bytes : turns_.turn(scene)) {
      const auto packet = frame_->receive({kReplayer, 100, bytes});
      ASSERT_TRUE(packet.has_value());
      ASSERT_EQ(frame_->classify(*packet), Frame::Outcome::kThisFrame);
      frame_->fuse(*packet, now_us_, work::Crew());
    }
    frame_->finish(work::Crew(), [](auto /*stage*/) {});
    frame_->describe(now_us_, header, end);
    frame_->start_next(now_us_);
  }

  // How many cells are free, seen from the unit between these azimuths, and from 6 m on: nearer
  // ones are wider than a degree.
  [[nodiscard]] int free_cells(double from_deg = 0, double to_deg = 360) const {
    int free = 0;
    for (int i = 0; i < 1024; ++i) {
      for (int j = 0; j < 1024; ++j) {
        const double x = (i - 512 + 0.5) * 0.1 - kMount.x_m;
        const double y = (j - 512 + 0.5) * 0.1 - kMount.y_m;
        const double left_deg = std::atan2(y, x) * 180 / std::numbers::pi - kMount.yaw_deg;
        const double azimuth_deg = std::fmod(720 - left_deg, 360);
        const bool is_there =
            azimuth_deg >= from_deg && azimuth_deg < to_deg && std::hypot(x, y) > 6;
        free += is_there && frame_->fusion().own().view().at({i, j}) < 0 ? 1 : 0;
      }
    }
    return free;
  }

  stream::Header header;
  stream::FrameEnd end;

 private:
  static constexpr std::uint32_t kReplayer = 0x0A000202;
  static constexpr description::MountConfig kMount = tests::LevelVlp16::kConfigs[0].mount;
  const vehicle::Vehicle& kCar = tests::LevelVlp16::kVehicle;
  std::unique_ptr<Frame> frame_ = std::make_unique<Frame>(kCar, kReplayer);
  tests::SceneTurns turns_;
  std::uint64_t now_us_ = 0;
};

TEST(Frame, MissingReturnsOfTheOpenSkyClear) {
  Drive drive;
  drive.turn(
      [](double azimuth, int elevation) { return elevation < -4 ? field(azimuth, elevation) : 0; });
  EXPECT_GT(drive.free_cells(), 105'000) << "from 6 to 20 m are 114,354 cells";
}

TEST(Frame, ACapFromTheStartClearsNothing) {
  Drive drive;
  for (int i = 0; i < 5; ++i) {
    drive.turn(covered);
    EXPECT_EQ(drive.free_cells(), 0) << i;
    EXPECT_EQ(drive.end.unwatched, ~std::uint64_t{0}) << i;
    EXPECT_EQ(drive.end.sensors[0].blocked, intake::Blocked::kWhole) << i;
  }
}

// In the very turn in which it comes over the unit.
TEST(Frame, ACoverThatComesLaterClearsNothing) {
  Drive drive;
  drive.turn(field);
  drive.turn([](double azimuth, int elevation) {
    return azimuth >= 123.4 && azimuth < 310 ? 0 : field(azimuth, elevation);
  });
  EXPECT_EQ(drive.free_cells(124.4, 309), 0);
  EXPECT_GT(drive.free_cells(320, 360), 3'000);
  drive.turn(covered);
  EXPECT_EQ(drive.free_cells(), 0);
  for (int i = 0; i < 4; ++i) {
    drive.turn(field);
  }
  EXPECT_GT(drive.free_cells(), 60'000);
  EXPECT_EQ(drive.end.blocked, 0U);
}

// A robot's level scanner in a corridor: infinity ahead frees a wedge of 80 degrees to 20 m, in
// every frame.
TEST(Frame, InfinityAheadOfALevelScannerClears) {
  const std::array sensors{
      description::sensor_of(tests::FlatScanner::config(), tests::FlatScanner::kDescription)};
  const vehicle::Vehicle car = description::vehicle_of(tests::FlatScanner::kDescription, sensors);
  const auto frame = std::make_unique<Frame>(car, 0x0A000202);
  tests::FlatScans scans;
  for (std::uint64_t i = 1; i <= 40; ++i) {
    frame->fusion().own().clear();
    for (const auto& bytes : scans.scan([](int at) { return std::abs(at) < 40 ? 0 : 2'000; })) {
      const auto packet = frame->receive({0x0A000202, 100, bytes});
      ASSERT_TRUE(packet.has_value());
      ASSERT_EQ(frame->classify(*packet), Frame::Outcome::kThisFrame);
      frame->fuse(*packet, i * 100'000, work::Crew());
    }
    frame->finish(work::Crew(), [](auto /*stage*/) {});
    for (const int x_dm : {5, 50, 100, 150, 190}) {
      for (const int left_dm : {-x_dm / 2, 0, x_dm / 2}) {
        const int along_dm = x_dm * 9 / 10;  // the side cells are less than 20 m away
        EXPECT_LT(frame->fusion().own().view().at({512 + along_dm, 512 + left_dm}), 0)
            << i << ' ' << along_dm << ' ' << left_dm;
      }
    }
    frame->start_next(i * 100'000);
  }
}

TEST(Frame, SaysHowItWasClosedAndFused) {
  for (const bool is_bayes : {false, true}) {
    vehicle::Vehicle car = tests::LevelVlp16::kVehicle;
    car.rule = is_bayes ? vehicle::FusionRule::kBayes : vehicle::FusionRule::kHitsWin;
    const auto frame = std::make_unique<Frame>(car, 0);
    stream::Header header;
    stream::FrameEnd end;
    frame->describe(0, header, end);
    EXPECT_EQ(header.flags, is_bayes ? 0x02 : 0x00);
    frame->describe(frame->deadline_us(), header, end);
    EXPECT_EQ(header.flags, is_bayes ? 0x03 : 0x01);
    EXPECT_EQ(header.vehicle_id, car.id);
    EXPECT_EQ(header.sensor_count, 1);
  }
}

}  // namespace
}  // namespace iog::app
