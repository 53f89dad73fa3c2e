#include "lab/experiments/many_core/many_core_contest.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "lab/evidence/frame_points.hpp"
#include "lidar/ibeo_lux.hpp"

namespace iog::lab {
namespace {

using reference::LuxScans;
using reference::Operations;
using reference::PlaneScan;

constexpr std::uint32_t kFrameStep = 5;
constexpr std::size_t kTimedRounds = 5;

// What some LUX of a vehicle measure in one frame.
class LuxSensors {
 public:
  LuxSensors(const tools::CatalogueEntry& car, std::vector<std::size_t> sensors)
      : sensors_(std::move(sensors)) {
    for (const std::size_t sensor : sensors_) {
      const description::SensorConfig& config = car.sensors[sensor];
      const std::uint32_t echoes = LuxScans::kLayers * lidar::IbeoLux::kMaxEchoes;
      const std::uint32_t directions = config.max_points_per_scan / echoes;
      const std::uint32_t step = config.scan_width_ticks / (directions - 1);
      scans_.emplace_back(config.mount, static_cast<std::int32_t>(step));
    }
  }

  void measure(const FramePoints& points) {
    std::ranges::for_each(scans_, &LuxScans::clear);
    for (const SensorPoint& each : points) {
      const auto found = std::ranges::find(sensors_, each.sensor);
      if (found != sensors_.end()) {
        scans_[static_cast<std::size_t>(found - sensors_.begin())].add(each.point);
      }
    }
  }

  [[nodiscard]] std::vector<PlaneScan> layers() const {
    std::vector<PlaneScan> layers;
    for (const LuxScans& scans : scans_) {
      std::ranges::copy(scans.scans(), std::back_inserter(layers));
    }
    return layers;
  }

 private:
  std::vector<std::size_t> sensors_;  // places in Vehicle::sensors
  std::vector<LuxScans> scans_;
};

void add(const Operations& one, Operations& sum) {
  sum.searches += one.searches;
  sum.models += one.models;
  sum.fusions += one.fusions;
  sum.accesses += one.accesses;
}

template <typename Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void run(Contests& contests, std::span<const PlaneScan> scans) {
  contests.fine.run(scans);
  contests.coarse.run(scans);
  ++contests.frames;
}

}  // namespace

Contest::Contest(double cell_m)
    : grid_{.x_min_m = 0,
            .y_min_m = -15,
            .cell_m = cell_m,
            .columns = static_cast<std::int32_t>(std::lround(50 / cell_m)),
            .rows = static_cast<std::int32_t>(std::lround(30 / cell_m))},
      by_cells_(grid_.cells()),
      by_beams_(grid_.cells()) {}

void Contest::run(std::span<const PlaneScan> scans) {
  add(run_cells(scans), cbc_);
  add(run_beams(scans), bbb_);
  for (std::size_t i = 0; i < grid_.cells(); ++i) {
    differing_cells_ += by_cells_[i] == by_beams_[i] ? 0U : 1U;
  }
}

double Contest::time_ratio(std::span<const PlaneScan> scans) {
  std::vector<double> ratios;
  for (std::size_t round = 0; round < kTimedRounds; ++round) {
    const double cells_s = seconds_of([&] { run_cells(scans); });
    const double beams_s = seconds_of([&] { run_beams(scans); });
    ratios.push_back(cells_s / beams_s);
  }
  std::ranges::sort(ratios);
  return ratios[kTimedRounds / 2];
}

Operations Contest::run_cells(std::span<const PlaneScan> scans) {
  return reference::cell_by_cell(grid_, scans, model_, by_cells_);
}

Operations Contest::run_beams(std::span<const PlaneScan> scans) {
  return reference::beam_by_beam(grid_, scans, model_, reference::kLuxStopBehindM, by_beams_);
}

DriveOutcome contest_on_drive(const Input& input) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  LuxSensors lux(
      car, {tools::sensor_of_name(car, "front_left"), tools::sensor_of_name(car, "front_right")});
  tools::Drive drive(car, input.seed, input.seconds);
  DriveOutcome outcome;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += kFrameStep) {
    lux.measure(points_of(drive, frame, car));
    const std::vector<PlaneScan> layers = lux.layers();
    run(outcome.contests, layers);
    if (frame == 0) {
      outcome.fine_time_ratio = outcome.contests.fine.time_ratio(layers);
      outcome.coarse_time_ratio = outcome.contests.coarse.time_ratio(layers);
    }
  }
  return outcome;
}

}  // namespace iog::lab
