// A short simulated drive and what the target makes of it, for the tests of tools/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "lidar/ibeo_lux.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/simulate/drive.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

using Messages = std::vector<std::vector<std::byte>>;

inline std::vector<CapturedDatagram> sample_drive(const CatalogueEntry& car, std::uint64_t seed,
                                                  std::uint32_t frames,
                                                  std::string_view scene = kDefaultScene) {
  Drive drive(car, seed, 1, find_scene(scene));
  std::vector<CapturedDatagram> datagrams;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    drive.move_to(frame);
    for (CapturedDatagram& datagram : drive.datagrams()) {
      datagrams.push_back(std::move(datagram));
    }
  }
  return datagrams;
}

// Every message that the target sends about these datagrams.
inline Messages messages_of(const CatalogueEntry& car,
                            const std::vector<CapturedDatagram>& datagrams) {
  Messages messages;
  const auto target =
      std::make_unique<OfflineTarget>(*car.vehicle, [&](std::span<const std::byte> message) {
        messages.emplace_back(message.begin(), message.end());
      });
  for (const CapturedDatagram& datagram : datagrams) {
    static_cast<void>(target->take(datagram));
  }
  target->finish();
  return messages;
}

// Calls visit(const vehicle::Sensor&, const lidar::ScanPoint&) for each point of the frame that the
// drive stands at. The car's scanners are LUX.
template <typename Visit>
void for_each_point(Drive& drive, const CatalogueEntry& car, Visit&& visit) {
  lidar::IbeoLux decoder;
  for (const CapturedDatagram& datagram : drive.datagrams()) {
    const auto& sensor = car.vehicle->sensors[sensor_of_port(car, datagram.destination.port)];
    if (decoder.decode(datagram.payload) == lidar::DecodeStatus::kOk) {
      decoder.for_each_point([&](const lidar::ScanPoint& point) { visit(sensor, point); });
    }
  }
}

}  // namespace iog::tools
