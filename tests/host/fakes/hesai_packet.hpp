// Builds Hesai data packets byte by byte from the formats' description (docs/spec.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace iog::tests {

struct HesaiPacket {
  bool is_xt32 = false;
  int first_azimuth = 0;  // 0.01 degrees, clockwise
  int step = 20;          // from block to block, in dual mode from pair to pair
  int mode = 0x37;
  bool is_dual = false;
  std::array<int, 6> utc{24, 2, 29, 23, 59, 59};  // the first as it is on the wire
  std::uint32_t time_us = 500'000;
  bool has_sequence = true;                     // of a Pandar64
  std::array<std::array<int, 64>, 8> ranges{};  // 4 mm

  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> out;
    const auto append = [&](const std::vector<int>& values) {
      for (const int value : values) {
        out.push_back(static_cast<std::byte>(value));
      }
    };
    const int blocks = is_xt32 ? 8 : 6;
    const std::size_t lasers = is_xt32 ? 32 : 64;
    append(is_xt32 ? std::vector{0xEE, 0xFF, 6, 1, 0, 0, 32, 8, 1, 4, is_dual ? 2 : 1, 0}
                   : std::vector{0xEE, 0xFF, 64, 6, 0, 4, 0, 0});
    for (int block = 0; block < blocks; ++block) {
      const int azimuth = (first_azimuth + (is_dual ? block / 2 : block) * step) % 36'000;
      append({azimuth & 0xFF, azimuth >> 8});
      for (std::size_t laser = 0; laser < lasers; ++laser) {
        const int range = ranges[static_cast<std::size_t>(block)][laser];
        append({range & 0xFF, range >> 8, 33});
        append(is_xt32 ? std::vector{255} : std::vector<int>{});
      }
    }
    const auto us = static_cast<int>(time_us);
    const std::vector<int> time{us & 0xFF, us >> 8 & 0xFF, us >> 16 & 0xFF, us >> 24 & 0xFF};
    const std::vector<int> date(utc.begin(), utc.end());
    out.resize(out.size() + (is_xt32 ? 10 : 8));
    if (is_xt32) {
      append({mode, 0x57, 0x02});
      append(date);
      append(time);
      append({0x42, 1, 2, 3, 4});
    } else {
      append({0x57, 0x02});
      append(time);
      append({mode, 0x42});
      append(date);
      append(has_sequence ? std::vector{1, 2, 3, 4} : std::vector<int>{});
    }
    return out;
  }
};

}  // namespace iog::tests
