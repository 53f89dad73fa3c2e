// Builds Velodyne data packets byte by byte from the format's description (docs/spec.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace iog::tests {

struct VelodynePacket {
  int first_azimuth = 0;  // 0.01 degrees, clockwise
  int step = 40;          // from one azimuth to the next
  int mode = 0x37;        // of an HDL-64E: the status type
  int product = 0x22;     // of an HDL-64E: the status value
  std::uint32_t time_us = 0;
  std::array<std::array<int, 32>, 12> ranges{};  // in units of range
  int blocks_of_azimuth = 0;                     // 0: by the mode, the banks or, if dual, twice
  int banks = 1;                                 // 2 of an HDL-64E, 4 of a VLS-128

  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> out;
    const auto little = [&](std::uint32_t value, int size) {
      for (int i = 0; i < size; ++i) {
        out.push_back(static_cast<std::byte>(value >> (8 * i)));
      }
    };
    const int of_mode = banks * (mode == 0x39 ? 2 : 1);
    const int together = blocks_of_azimuth == 0 ? of_mode : blocks_of_azimuth;
    for (int block = 0; block < 12; ++block) {
      little(0xEEFFU - static_cast<std::uint32_t>(block % banks) * 0x1100U, 2);
      little(static_cast<std::uint32_t>((first_azimuth + block / together * step) % 36000), 2);
      for (const int range : ranges[static_cast<std::size_t>(block)]) {
        little(static_cast<std::uint32_t>(range), 2);
        little(50, 1);  // reflectivity
      }
    }
    little(time_us, 4);
    little(static_cast<std::uint32_t>(mode), 1);
    little(static_cast<std::uint32_t>(product), 1);
    return out;
  }
};

}  // namespace iog::tests
