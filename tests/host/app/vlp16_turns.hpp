// Turns of a lidar that sees walls everywhere: datagrams for tests of frames of dense lidars.
#pragma once

#include <cstdint>
#include <vector>

#include "fakes/random.hpp"
#include "fakes/velodyne_packet.hpp"
#include "perception_drive.hpp"

namespace iog::app::testing {

// Turns of a VLP-16 at 5 Hz (User Manual 63-9243): an azimuth in 110.592 us and 0.2 degrees on.
// With two returns a packet has six of them, with one twelve. Walls are everywhere, at any range up
// to so many units of 2 mm; every fifth shot comes back from nowhere.
inline std::vector<TimedDatagram> turns_of_vlp16(std::uint16_t port, int turns, bool is_dual,
                                                 int range) {
  constexpr int kStep = 20;
  const int azimuths = is_dual ? 6 : 12;
  tests::Random random(port);
  std::vector<TimedDatagram> drive;
  for (int packet = 0; packet < turns * 36'000 / (azimuths * kStep); ++packet) {
    const int us = static_cast<int>(packet * azimuths * 110.592);
    tests::VelodynePacket sent{.first_azimuth = packet * azimuths * kStep % 36'000,
                               .step = kStep,
                               .mode = is_dual ? 0x39 : 0x37,
                               .time_us = static_cast<std::uint32_t>(us)};
    for (auto& block : sent.ranges) {
      for (int& unit : block) {
        unit =
            random.one_in(5)
                ? 0
                : 1'500 + static_cast<int>(random.below(static_cast<std::uint32_t>(range - 1'500)));
      }
    }
    drive.push_back({1'000'000 + static_cast<std::uint64_t>(us), port, sent.bytes()});
  }
  return drive;
}

}  // namespace iog::app::testing
