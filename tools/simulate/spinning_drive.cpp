#include "tools/simulate/spinning_drive.hpp"

#include <algorithm>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/drive.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kFrameNs = 1'000'000'000 / SpinningDrive::kFramesPerSecond;

bool turns(const vehicle::SensorConfig& sensor) { return sender_of(sensor) != nullptr; }

}  // namespace

bool spins(const CatalogueEntry& car) { return std::ranges::all_of(car.sensors, turns); }

bool spins_partly(const CatalogueEntry& car) { return std::ranges::any_of(car.sensors, turns); }

SpinningDrive::SpinningDrive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
                             const SceneEntry& scene)
    : car_(&car),
      seed_(seed),
      frame_count_(seconds * kFramesPerSecond),
      scene_(scene.make(seed, seconds)) {
  for (const vehicle::SensorConfig& sensor : car.sensors) {
    scanners_.emplace_back(sensor);
    senders_.push_back(sender_of(sensor));
  }
}

void SpinningDrive::move_to(std::uint32_t frame) {
  frame_ = frame;
  const double time_s = (frame + 0.5) / kFramesPerSecond;
  ego_ = scene_.ego_at(time_s);
  solids_.clear();
  scene_.append_seen_at(time_s, solids_);
  for (SpinningScanner& scanner : scanners_) {
    scanner.move_to(ego_, solids_);
  }
}

void SpinningDrive::append_packets(std::size_t sensor, std::vector<CapturedDatagram>& datagrams) {
  const vehicle::SensorConfig& config = car_->sensors[sensor];
  const SpinningSender& sender = *senders_[sensor];
  const std::uint64_t packet_ns = sender.packet_ns();
  const std::uint64_t begin_ns = frame_ * kFrameNs;
  Random random = noise_of_scan(seed_, frame_, sensor);
  const std::uint32_t source = config.source_ipv4 != 0 ? config.source_ipv4 : kUnnamedIpv4;
  for (std::uint64_t number = (begin_ns + packet_ns - 1) / packet_ns;
       number * packet_ns < begin_ns + kFrameNs; ++number) {
    datagrams.push_back(
        {.time_us = kDriveStartUs + (number + 1) * packet_ns / 1000,
         .source = {source, config.udp_port},
         .destination = {kTargetIpv4, config.udp_port},
         .payload = sender.packet(number * packet_ns, number, scanners_[sensor], random)});
  }
}

std::vector<CapturedDatagram> SpinningDrive::datagrams() {
  std::vector<CapturedDatagram> datagrams;
  for (std::size_t sensor = 0; sensor < car_->sensors.size(); ++sensor) {
    append_packets(sensor, datagrams);
  }
  std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
  return datagrams;
}

}  // namespace iog::tools
