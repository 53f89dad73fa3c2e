// A car drives uphill, braking and pitching, and follows the ground: what the classes say of road,
// kerb, pavement and verge, point by point against what is true of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "fakes/ground_car.hpp"
#include "lidar/velodyne_hdl32e.hpp"
#include "stream/class_window.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/drives/pose_source.hpp"

namespace iog::tools {
namespace {

constexpr std::uint32_t kSeconds = 3;
constexpr std::uint64_t kWarmUpUs = 1'000'000;
constexpr std::uint64_t kSeed = 5;
constexpr std::int32_t kReachCells = 3;
constexpr std::uint32_t kFarthestMm = 25'000;
// Both lanes, the kerb, the pavement and the left verge (docs/drives.md); not the banks, which are
// steep.
constexpr double kRightM = -4;
constexpr double kLeftM = 6;
constexpr std::uint8_t kMoving = 4;

using WorldCell = std::pair<std::int32_t, std::int32_t>;

// In the vehicle frame as the firmware has it, as if the car and the world were level. The unit is
// over the car's origin.
struct LevelPlace {
  double x = 0;
  double y = 0;
};
LevelPlace level_place_of(const lidar::ScanPoint& point) {
  const double elevation = lidar::VelodyneHdl32e::kElevationsDeg.at(point.layer) * kRadians;
  const double azimuth = 2 * std::numbers::pi * point.azimuth_ticks / 36'000;
  const double r = point.range_mm / 1000.0 * std::cos(elevation);
  return {r * std::cos(azimuth), r * std::sin(azimuth)};
}

WorldCell cell_of(const LevelPlace& place, const EgoPose& ego) {
  const auto cell = [](double metres) {
    return static_cast<std::int32_t>(std::floor(metres * 10));
  };
  return {cell(ego.at.x + place.x * ego.at.cos - place.y * ego.at.sin),
          cell(ego.at.y + place.x * ego.at.sin + place.y * ego.at.cos)};
}

// Of the ground.
struct GroundPoint {
  std::uint64_t time_us = 0;
  WorldCell cell;
};

struct TakenGround {
  std::uint32_t points = 0;
  std::uint32_t taken = 0;  // moving, standing, or occupied by what is not yet known
  [[nodiscard]] double percent_taken() const { return 100.0 * taken / points; }
};

std::uint8_t class_at(const ClassGrid& classes, const WorldCell& cell) {
  const std::int32_t x = cell.first - classes.window.corner_a * 32;
  const std::int32_t y = cell.second - classes.window.corner_b * 32;
  if (x < 0 || y < 0 || x >= 1024 || y >= 1024) {
    return 0;
  }
  return stream::class_of(static_cast<std::byte>(
      classes.cells[static_cast<std::size_t>(y) * 1024 + static_cast<std::size_t>(x)]));
}

// Cells with what is no ground, and those around them. Many points are in one cell.
class Surroundings {
 public:
  void add(const WorldCell& cell) {
    if (!cells_.insert(cell).second) {
      return;
    }
    for (std::int32_t y = -kReachCells; y <= kReachCells; ++y) {
      for (std::int32_t x = -kReachCells; x <= kReachCells; ++x) {
        around_.insert({cell.first + x, cell.second + y});
      }
    }
  }
  [[nodiscard]] bool contains(const WorldCell& cell) const { return around_.contains(cell); }

 private:
  std::set<WorldCell> cells_;
  std::set<WorldCell> around_;
};

// What a target says of points of the ground: of each by the first frame that has placed a later
// slice; not beside what is no ground.
class GroundWatch {
 public:
  GroundWatch(const vehicle::Vehicle& vehicle, const Surroundings& near_things)
      : near_things_(near_things),
        assembler_([this](GridFrame&& frame) { take(frame); }),
        target_(std::make_unique<OfflineTarget>(
            vehicle, [this](std::span<const std::byte> message) { assembler_.take(message); })) {}

  void wait_for(const GroundPoint& point) { waiting_.push_back(point); }
  void take(const CapturedDatagram& datagram) { static_cast<void>(target_->take(datagram)); }
  void finish() {
    target_->finish();
    assembler_.finish();
  }
  [[nodiscard]] const TakenGround& said() const { return said_; }

 private:
  void take(const GridFrame& frame) {
    if (!frame.classes || !frame.classes->window.has_place()) {
      return;
    }
    const auto is_taken = [&](const GroundPoint& point) {
      return point.time_us < frame.classes->window.slices_end_us;
    };
    for (const GroundPoint& point : waiting_) {
      if (is_taken(point) && point.time_us > kDriveStartUs + kWarmUpUs &&
          !near_things_.contains(point.cell)) {
        ++said_.points;
        said_.taken += class_at(*frame.classes, point.cell) >= kMoving ? 1U : 0U;
      }
    }
    std::erase_if(waiting_, is_taken);
  }

  const Surroundings& near_things_;
  TakenGround said_;
  std::vector<GroundPoint> waiting_;
  FrameAssembler assembler_;
  std::unique_ptr<OfflineTarget> target_;
};

// The targets get the same drive, which takes longer to make than to fuse.
void drive_uphill(std::span<GroundWatch* const> watches, Surroundings& near_things) {
  Scene scene = find_scene("hills").make(kSeed, kSeconds);
  scene.attitude.emplace(kSeed);
  Drive drive(find_vehicle("roof_hdl32e"), kSeed, kSeconds, std::move(scene), Motion::kContinuous);
  PoseFeed poses(simulated_poses(drive.scene(), {}, kSeed, kSeconds + 0.1));
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    std::vector<SimulatedPacket> packets = drive.packets(frame);
    for (const SimulatedPacket& packet : packets) {
      const std::uint64_t time_us = packet.datagram.time_us;
      const EgoPose ego = drive.scene().ego_at(static_cast<double>(time_us - kDriveStartUs) / 1e6);
      lidar::VelodyneHdl32e decoder;
      ASSERT_EQ(decoder.decode(packet.datagram.payload), lidar::DecodeStatus::kOk);
      std::size_t i = 0;
      decoder.for_each_point([&](const lidar::ScanPoint& point) {
        const PointTruth& truth = packet.points[i++];
        if (truth.what >= PointClass::kClutter || point.range_mm > kFarthestMm) {
          return;
        }
        const LevelPlace place = level_place_of(point);
        const WorldCell cell = cell_of(place, ego);
        if (truth.what != PointClass::kGround) {
          near_things.add(cell);
        } else if (place.y > kRightM && place.y < kLeftM) {
          for (GroundWatch* watch : watches) {
            watch->wait_for({time_us, cell});
          }
        }
      });
    }
    const auto datagrams = with_poses(datagrams_of(std::move(packets)), poses);
    for (const CapturedDatagram& datagram : datagrams) {
      for (GroundWatch* watch : watches) {
        watch->take(datagram);
      }
    }
  }
  for (GroundWatch* watch : watches) {
    watch->finish();
  }
}

vehicle::Vehicle with_classes(vehicle::Vehicle vehicle) {
  vehicle.grids = vehicle::Grids::kBoth;
  vehicle.frame_period_us = 40'000;
  return vehicle;
}

TEST(HillsClasses, GroundIsNoObstacleToACarThatFollowsIt) {
  const vehicle::Vehicle car = with_classes(*find_vehicle("roof_hdl32e").vehicle);
  const tests::GroundCar flat(car, {});
  Surroundings near_things;
  GroundWatch follows(car, near_things);
  GroundWatch keeps(flat.vehicle(), near_things);
  drive_uphill(std::array{&follows, &keeps}, near_things);
  ASSERT_GT(follows.said().points, 200'000U);
  EXPECT_EQ(follows.said().points, keeps.said().points);
  EXPECT_LE(follows.said().percent_taken(), 0.5);
  EXPECT_GE(keeps.said().percent_taken(), 5);  // the road rises into the height band
}

}  // namespace
}  // namespace iog::tools
