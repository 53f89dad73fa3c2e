// What was measured on the target (lab/data/cortex_a9.csv) is what is computed here: the same
// frames, the same points, and the same grids to the byte.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "gtest/gtest.h"

#include "lab/experiments/target_drive.hpp"
#include "lab/reference/many_core.hpp"
#include "lab/scenarios/worst_frames.hpp"
#include "lidar/ibeo_lux.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/simulate/drives/drive.hpp"

namespace iog::lab {
namespace {

// How the first line with this beginning goes on; nothing if there is none.
std::string rest_of_line(const std::string& table, const std::string& beginning) {
  std::ifstream lines(IOG_SOURCE_DIR "/lab/data/" + table);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(beginning)) {
      return line.substr(beginning.size());
    }
  }
  return {};
}

// Of the whole run.
std::string measured(const std::string& run, const std::string& counter) {
  return rest_of_line("cortex_a9.csv", run + ",,counted," + counter + ",");
}

constexpr const char* kCity = "city";
constexpr const char* kRingRoad = "ring_road";

std::string frame_cost(const std::string& scene, std::size_t sensors) {
  return "frame_cost scene=" + scene + " sensors=" + std::to_string(sensors);
}

// The PC's own account of a run.
struct Account {
  tools::RunHash hash;
  std::uint64_t frames = 0;
  std::uint64_t points_used = 0;
};

class Accountant {
 public:
  // vehicle outlives the accountant.
  explicit Accountant(const vehicle::Vehicle& vehicle)
      : assembler_([this](const tools::GridFrame& frame) { add(frame); }),
        target_(std::make_unique<tools::OfflineTarget>(
            vehicle, [this](std::span<const std::byte> message) { assembler_.take(message); })) {}

  void take(const std::vector<tools::CapturedDatagram>& frame) {
    for (const tools::CapturedDatagram& datagram : frame) {
      static_cast<void>(target_->take(datagram));
    }
  }

  Account finish() {
    target_->finish();
    assembler_.finish();
    return account_;
  }

 private:
  void add(const tools::GridFrame& frame) {
    if (!frame.header.has_evidence()) {
      return;  // it says that the other scanners' packets were dropped
    }
    account_.hash.add(tools::grid_crc_of(frame));
    ++account_.frames;
    account_.points_used += frame.header.points_used;
  }

  Account account_;
  tools::FrameAssembler assembler_;
  std::unique_ptr<tools::OfflineTarget> target_;
};

// Of a fixed drive, fused by a car that has only its first scanners.
Account account_of(const char* scene, std::size_t sensors) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  vehicle::Vehicle vehicle = *car.vehicle;
  vehicle.sensors = vehicle.sensors.first(sensors);
  Accountant accountant(vehicle);
  tools::Drive drive(car, kTargetSeed, kTargetSeconds, tools::find_scene(scene));
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    accountant.take(drive.datagrams(frame));
  }
  return accountant.finish();
}

// Of the worst frames of one kind.
Account account_of(const WorstFrame& worst) {
  Accountant accountant(*tools::find_vehicle("reference_car").vehicle);
  for (std::uint32_t frame = 0; frame < kMeasuredWorstFrames; ++frame) {
    accountant.take(worst_datagrams(worst, kTargetSeed, frame));
  }
  return accountant.finish();
}

void expect_measured(const std::string& run, const Account& account) {
  EXPECT_EQ(measured(run, "frames"), std::to_string(account.frames));
  EXPECT_EQ(measured(run, "points_used"), std::to_string(account.points_used));
  EXPECT_EQ(measured(run, "run_hash"), tools::hex(account.hash.value()));
}

class TargetDrive : public testing::TestWithParam<std::tuple<const char*, std::size_t>> {};

TEST_P(TargetDrive, FusedTheGridsThatThePcFuses) {
  const auto [scene, sensors] = GetParam();
  expect_measured(frame_cost(scene, sensors), account_of(scene, sensors));
}

INSTANTIATE_TEST_SUITE_P(ScenesAndSensors, TargetDrive,
                         testing::Combine(testing::Values(kCity, kRingRoad),
                                          testing::Values(2U, 3U, 4U)));

class TargetWorstFrames : public testing::TestWithParam<WorstFrame> {};

TEST_P(TargetWorstFrames, FusedTheGridsThatThePcFuses) {
  expect_measured("frame_cost worst=" + std::string(GetParam().name) + " sensors=4",
                  account_of(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Frames, TargetWorstFrames,
                         testing::ValuesIn(all_worst_frames().begin(), all_worst_frames().end()),
                         [](const auto& frame) { return std::string(frame.param.name); });

// The first frame of the drive as the two front corners' LUX see it.
void measure_first_frame(reference::LuxScans& left, reference::LuxScans& right) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  tools::Drive drive(car, kTargetSeed, kTargetSeconds);
  for (const tools::CapturedDatagram& datagram : drive.datagrams(0)) {
    const std::size_t sensor = tools::sensor_of_port(car, datagram.destination.port);
    if (sensor == tools::sensor_of_name(car, "front_centre") ||
        sensor == tools::sensor_of_name(car, "rear_centre")) {
      continue;
    }
    lidar::IbeoLux lux;
    ASSERT_EQ(lux.decode(datagram.payload), lidar::DecodeStatus::kOk);
    lux.for_each_point([&](const lidar::ScanPoint& point) {
      (sensor == tools::sensor_of_name(car, "front_left") ? left : right).add(point);
    });
  }
}

// The many-core paper's approaches did there what they do here.
TEST(TargetManyCore, DidTheWorkThatThePcDoes) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  reference::LuxScans left(car.sensors[tools::sensor_of_name(car, "front_left")].mount);
  reference::LuxScans right(car.sensors[tools::sensor_of_name(car, "front_right")].mount);
  measure_first_frame(left, right);
  std::vector<reference::PlaneScan> scans;
  for (const reference::LuxScans* lux : {&left, &right}) {
    std::ranges::copy(lux->scans(), std::back_inserter(scans));
  }
  const reference::PlaneGrid grid{
      .x_min_m = 0, .y_min_m = -15, .cell_m = 0.2, .columns = 250, .rows = 150};
  std::vector<double> cells(grid.cells());
  const auto expect_same = [](const char* run, const reference::Operations& operations) {
    EXPECT_EQ(measured(run, "searches"), std::to_string(operations.searches)) << run;
    EXPECT_EQ(measured(run, "models"), std::to_string(operations.models)) << run;
    EXPECT_EQ(measured(run, "fusions"), std::to_string(operations.fusions)) << run;
  };
  const reference::AnalyticModel model = reference::lux_model();
  expect_same("many_core approach=cbc cell_mm=200",
              reference::cell_by_cell(grid, scans, model, cells));
  expect_same("many_core approach=bbb cell_mm=200",
              reference::beam_by_beam(grid, scans, model, reference::kLuxStopBehindM, cells));
}

// The drive that the target saw is the one that is simulated here.
TEST(TargetDrives, AreThoseOfTheHead) {
  const std::string drive = "iog simulate --vehicle reference_car --seed " +
                            std::to_string(kTargetSeed) + " --seconds " +
                            std::to_string(kTargetSeconds);
  EXPECT_EQ(rest_of_line("made_with.csv", "capture scene=city,"), drive);
  EXPECT_EQ(rest_of_line("made_with.csv", "capture scene=ring_road,"),
            drive + " --scene ring_road");
}

}  // namespace
}  // namespace iog::lab
