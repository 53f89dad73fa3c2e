#include "tools/simulate/drive.hpp"

#include <string>

#include "lidar/formats.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {

Random noise_of_scan(std::uint64_t seed, std::uint32_t frame, std::size_t sensor) {
  constexpr std::uint64_t kNoiseStreams = 1000;  // the world's own streams are below
  return Random(seed, kNoiseStreams + std::uint64_t{frame} * vehicle::kMaxSensors + sensor);
}

std::vector<LuxScanner> scanners_of(const CatalogueEntry& car) {
  std::vector<LuxScanner> scanners;
  for (const vehicle::SensorConfig& sensor : car.sensors) {
    if (!sends_lux_scans(sensor.format)) {
      throw UsageError("such drives are simulated for ibeo LUX scanners, and " +
                       std::string(car.vehicle->name) + " has a " +
                       std::string(lidar::name_of(sensor.format)));
    }
    scanners.emplace_back(sensor);
  }
  return scanners;
}

Drive::Drive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
             const SceneEntry& scene)
    : car_(&car),
      seed_(seed),
      frame_count_(seconds * kFramesPerSecond),
      scene_(scene.make(seed, seconds)),
      scanners_(scanners_of(car)) {}

void Drive::move_to(std::uint32_t frame) {
  frame_ = frame;
  const double time_s = static_cast<double>(frame) / kFramesPerSecond;
  ego_ = scene_.ego_at(time_s);
  solids_.clear();
  scene_.append_seen_at(time_s, solids_);
}

std::vector<CapturedDatagram> Drive::datagrams() {
  return lux_burst(*car_, frame_, [this](std::size_t sensor) {
    Random random = noise_of_scan(seed_, frame_, sensor);
    return scanners_[sensor].scan(ego_, solids_, side_of_scan(frame_ + 1), random);
  });
}

}  // namespace iog::tools
