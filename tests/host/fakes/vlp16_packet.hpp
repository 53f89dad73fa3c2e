// Builds Velodyne VLP-16 data packets byte by byte from the format's description (docs/spec.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace iog::tests {

struct Vlp16Packet {
  int first_azimuth = 0;  // 0.01 degrees, clockwise
  int step = 40;          // from block to block, in dual mode from pair to pair
  int mode = 0x37;
  int product = 0x22;
  std::uint32_t time_us = 0;
  std::array<std::array<int, 32>, 12> ranges{};  // 2 mm

  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> out;
    const auto little = [&](std::uint32_t value, int size) {
      for (int i = 0; i < size; ++i) {
        out.push_back(static_cast<std::byte>(value >> (8 * i)));
      }
    };
    for (int block = 0; block < 12; ++block) {
      const int turned = (mode == 0x39 ? block / 2 : block) * step;
      little(0xEEFF, 2);
      little(static_cast<std::uint32_t>((first_azimuth + turned) % 36000), 2);
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
