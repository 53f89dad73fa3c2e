// A short simulated drive and what the target makes of it, for the tests of tools/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tools/capture/datagram.hpp"
#include "tools/catalogue/vehicle_catalogue.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/simulate/drive.hpp"

namespace iog::tools {

using Messages = std::vector<std::vector<std::byte>>;

inline std::vector<CapturedDatagram> sample_drive(const CatalogueEntry& car, std::uint64_t seed,
                                                  std::uint32_t frames) {
  Drive drive(car, seed, 1);
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

}  // namespace iog::tools
