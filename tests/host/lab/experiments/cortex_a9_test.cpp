#include "lab/experiments/cortex_a9.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "gtest/gtest.h"

#include "lab/experiments/a9_frame.hpp"
#include "lab/reference/many_core.hpp"
#include "lab/scenarios/worst_frames.hpp"
#include "lidar/ibeo_lux.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/receive/frame_assembler.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/simulate/drive.hpp"

namespace iog::lab {
namespace {

constexpr const char* kCity = "city";
constexpr const char* kRingRoad = "ring_road";

std::string frame_cost(const std::string& scene, std::size_t sensors) {
  const std::string named = scene == kCity ? "" : "scene=" + scene + " ";
  return "frame_cost " + named + "sensors=" + std::to_string(sensors);
}

// The PC's own account of a run.
struct Account {
  tools::RunHash hash;
  double frames = 0;
  double points_used = 0;
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
    account_.hash.add(tools::record_of(frame));
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
  tools::Drive drive(car, kA9Seed, kA9Seconds, tools::find_scene(scene));
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    drive.move_to(frame);
    accountant.take(drive.datagrams());
  }
  return accountant.finish();
}

// Of the worst frames of one kind.
Account account_of(const WorstFrame& worst, double frames) {
  Accountant accountant(*tools::find_vehicle("reference_car").vehicle);
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    accountant.take(worst_datagrams(worst, kA9Seed, frame));
  }
  return accountant.finish();
}

void expect_measured(const std::string& run, const Account& account) {
  EXPECT_EQ(measured_on_a9(run, "frames"), account.frames);
  EXPECT_EQ(measured_on_a9(run, "points_used"), account.points_used);
  EXPECT_EQ(word_from_a9(run, "run_hash"), tools::hex(account.hash.value()));
}

// What was measured there is what is computed here: the same frames, the same points, and the same
// grids to the byte.
class CortexA9Drive : public testing::TestWithParam<std::tuple<const char*, std::size_t>> {};

TEST_P(CortexA9Drive, FusedTheGridsThatThePcFuses) {
  const auto [scene, sensors] = GetParam();
  expect_measured(frame_cost(scene, sensors), account_of(scene, sensors));
}

INSTANTIATE_TEST_SUITE_P(ScenesAndSensors, CortexA9Drive,
                         testing::Combine(testing::Values(kCity, kRingRoad),
                                          testing::Values(2U, 3U, 4U)));

class CortexA9Worst : public testing::TestWithParam<WorstFrame> {};

TEST_P(CortexA9Worst, FusedTheGridsThatThePcFuses) {
  const std::string run = "frame_cost worst=" + std::string(GetParam().name);
  expect_measured(run, account_of(GetParam(), measured_on_a9(run, "frames")));
}

INSTANTIATE_TEST_SUITE_P(Frames, CortexA9Worst,
                         testing::ValuesIn(all_worst_frames().begin(), all_worst_frames().end()),
                         [](const auto& frame) { return std::string(frame.param.name); });

// The first frame of the drive as the two front corners' LUX see it.
void measure_first_frame(reference::LuxScans& left, reference::LuxScans& right) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  tools::Drive drive(car, kA9Seed, kA9Seconds);
  drive.move_to(0);
  for (const tools::CapturedDatagram& datagram : drive.datagrams()) {
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
TEST(CortexA9, DidTheWorkThatThePcDoes) {
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
    EXPECT_EQ(measured_on_a9(run, "searches"), static_cast<double>(operations.searches)) << run;
    EXPECT_EQ(measured_on_a9(run, "models"), static_cast<double>(operations.models)) << run;
    EXPECT_EQ(measured_on_a9(run, "fusions"), static_cast<double>(operations.fusions)) << run;
  };
  const reference::AnalyticModel model = reference::lux_model();
  expect_same("many_core approach=cbc cell_mm=200",
              reference::cell_by_cell(grid, scans, model, cells));
  expect_same("many_core approach=bbb cell_mm=200",
              reference::beam_by_beam(grid, scans, model, reference::kLuxStopBehindM, cells));
}

TEST(CortexA9, AFrameCostsWhatItsStagesCost) {
  for (const char* const scene : {kCity, kRingRoad}) {
    for (const std::size_t sensors : {2U, 3U, 4U}) {
      const auto sum = [&](const char* stage) {
        return measured_on_a9(frame_cost(scene, sensors), std::string(stage) + "_sum");
      };
      EXPECT_EQ(sum("frame"), sum("receive") + sum("fuse") + sum("mark") + sum("publish"));
    }
  }
}

TEST(CortexA9, AFrameIsTheMeanOfItsScenesRun) {
  for (const char* const scene : {kCity, kRingRoad}) {
    const A9Frame frame = a9_frame(scene, 4);
    EXPECT_EQ(frame.sensors, 4);
    EXPECT_NEAR(frame.whole, measured_on_a9(frame_cost(scene, 4), "frame_mean"), 0.5) << scene;
    EXPECT_LT(frame.fused, frame.whole) << scene;
    EXPECT_GT(frame.largest, frame.whole) << scene;
  }
  EXPECT_THROW(static_cast<void>(a9_frame(kCity, 5)), std::out_of_range);
  EXPECT_THROW(static_cast<void>(a9_frame("moon", 4)), std::out_of_range);
}

// A cell's border is crossed at another place for another r, but a walk takes the same steps.
TEST(CortexA9, TheResolutionDoesNotChangeWhatACellCosts) {
  const auto per_cell = [](const char* walk) {
    const std::string run = std::string("traversal_cost walk=") + walk;
    return measured_on_a9(run, "instructions") / measured_on_a9(run, "cells");
  };
  for (const char* const walk : {"discrete r=20", "discrete r=100", "discrete r=200"}) {
    EXPECT_NEAR(per_cell(walk), per_cell("discrete r=1024"), 0.001) << walk;
  }
}

// A run's name ends where its line goes on with a blank: r=20 is not the beginning of r=200.
TEST(CortexA9, NamesAreWhole) {
  EXPECT_NE(measured_on_a9("traversal_cost walk=discrete r=20", "cells"),
            measured_on_a9("traversal_cost walk=discrete r=200", "cells"));
  EXPECT_THROW(static_cast<void>(measured_on_a9("traversal_cost walk=discrete r=2", "cells")),
               std::out_of_range);
  EXPECT_THROW(static_cast<void>(measured_on_a9("traversal_cost walk=bresenham", "cell")),
               std::out_of_range);
}

TEST(CortexA9, WordsAreNotNumbers) {
  EXPECT_EQ(word_from_a9(frame_cost(kCity, 4), "vehicle"), "reference_car");
  EXPECT_THROW(static_cast<void>(measured_on_a9(frame_cost(kCity, 4), "vehicle")),
               std::out_of_range);
}

TEST(CortexA9, TheHeadSaysWhatWasDriven) {
  const std::string drive = "iog simulate --vehicle reference_car --seed " +
                            std::to_string(kA9Seed) + " --seconds " + std::to_string(kA9Seconds);
  EXPECT_EQ(a9_made_with("capture"), drive);
  EXPECT_EQ(a9_made_with("capture scene=ring_road"), drive + " --scene ring_road");
}

TEST(CortexA9, TheHeadSaysWhatCounted) {
  EXPECT_EQ(a9_made_with("counting"), "-icount shift=4,sleep=off");
  EXPECT_NE(a9_made_with("compiler").find("arm-none-eabi"), std::string_view::npos);
  EXPECT_THROW(static_cast<void>(a9_made_with("weather")), std::out_of_range);
}

}  // namespace
}  // namespace iog::lab
