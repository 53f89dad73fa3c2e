#include "tools/simulate/moving_drive.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/lux/lux_burst.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kPhaseStream = 7;

// One somewhere in each of as many parts of the period as there are sensors, in random order: so
// the scans of a frame follow one another within one period, and no two end together.
std::vector<std::uint64_t> phases_of(std::size_t sensors, std::uint64_t seed) {
  Random random(seed, kPhaseStream);
  std::vector<std::size_t> order(sensors);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t last = sensors; last > 1; --last) {
    std::swap(order[last - 1], order[random.below(last)]);
  }
  std::vector<std::uint64_t> phases;
  for (const std::size_t part : order) {
    const double share = static_cast<double>(part) + random.between(0.1, 0.9);
    phases.push_back(static_cast<std::uint64_t>(share * kLuxPeriodUs) / sensors);
  }
  return phases;
}

double seconds_of(double time_us) { return time_us / 1'000'000; }

}  // namespace

MovingDrive::MovingDrive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
                         const SceneEntry& scene)
    : MovingDrive(car, seed, seconds, scene.make(seed, seconds)) {}

MovingDrive::MovingDrive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
                         Scene scene)
    : car_(&car),
      seed_(seed),
      frame_count_(seconds * kLuxFramesPerSecond),
      scene_(std::move(scene)),
      scanners_(scanners_of(car)),
      phases_us_(phases_of(scanners_.size(), seed)) {}

std::uint64_t MovingDrive::scan_end_us(std::size_t sensor, std::uint32_t frame) const {
  return (std::uint64_t{frame} + 1) * kLuxPeriodUs + phases_us_[sensor];
}

std::uint64_t MovingDrive::frame_end_us(std::uint32_t frame) const {
  const auto last = std::ranges::max_element(phases_us_) - phases_us_.begin();
  return scan_end_us(static_cast<std::size_t>(last), frame);
}

Sweep MovingDrive::sweep_until(std::uint64_t end_us) const {
  const auto begin_us = static_cast<double>(end_us - kLuxSweepUs);
  Sweep sweep;
  for (std::size_t column = 0; column < kLuxAzimuths; ++column) {
    const double share = static_cast<double>(column) / (kLuxAzimuths - 1);
    sweep.ego[column] = scene_.ego_at(seconds_of(begin_us + share * kLuxSweepUs));
  }
  sweep.solids =
      scene_.solids_between(seconds_of(begin_us), seconds_of(static_cast<double>(end_us)));
  return sweep;
}

std::vector<CapturedDatagram> MovingDrive::datagrams(std::uint32_t frame) {
  std::vector<CapturedDatagram> datagrams;
  for (std::size_t sensor = 0; sensor < scanners_.size(); ++sensor) {
    const std::uint64_t end_us = scan_end_us(sensor, frame);
    Random random = noise_of_scan(seed_, frame, sensor);
    const LuxScanTime time{sensor, frame, kDriveStartUs + end_us};
    append_lux_scan(
        *car_, time,
        scanners_[sensor].scan(sweep_until(end_us), side_of_scan(time.number()), random),
        time.end_us, datagrams);
  }
  std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
  return datagrams;
}

}  // namespace iog::tools
