#include "drive_sample.hpp"

#include <memory>
#include <span>
#include <utility>

#include "lidar/ibeo_lux.hpp"
#include "tools/fuse/offline_target.hpp"

namespace iog::tools {

std::vector<CapturedDatagram> sample_drive(const CatalogueEntry& car, std::uint64_t seed,
                                           std::uint32_t frames, std::string_view scene) {
  Drive drive(car, seed, 1, find_scene(scene));
  std::vector<CapturedDatagram> datagrams;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    for (CapturedDatagram& datagram : drive.datagrams(frame)) {
      datagrams.push_back(std::move(datagram));
    }
  }
  return datagrams;
}

Messages messages_of(const CatalogueEntry& car, const std::vector<CapturedDatagram>& datagrams) {
  return messages_of(car, datagrams, OfflineTarget::kRunNumber);
}

Messages messages_of(const CatalogueEntry& car, const std::vector<CapturedDatagram>& datagrams,
                     std::uint32_t run_number) {
  Messages messages;
  const auto target = std::make_unique<OfflineTarget>(
      *car.vehicle,
      [&](std::span<const std::byte> message) {
        messages.emplace_back(message.begin(), message.end());
      },
      Stopwatch::kRuns, run_number);
  for (const CapturedDatagram& datagram : datagrams) {
    static_cast<void>(target->take(datagram));
  }
  target->finish();
  return messages;
}

void for_each_point(Drive& drive, std::uint32_t frame, const CatalogueEntry& car,
                    const PointVisit& visit) {
  lidar::IbeoLux decoder;
  for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
    const auto& sensor = car.vehicle->sensors[sensor_of_port(car, datagram.destination.port)];
    if (decoder.decode(datagram.payload) == lidar::DecodeStatus::kOk) {
      decoder.for_each_point([&](const lidar::ScanPoint& point) { visit(sensor, point); });
    }
  }
}

}  // namespace iog::tools
