// Builds Ouster packets byte by byte from the format's description (docs/spec.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lidar/formats.hpp"

namespace iog::tests {

struct OusterPacket {
  lidar::Format format = lidar::kFormat<lidar::OusterLegacy>;
  int rows = 64;
  int columns_per_turn = 1024;
  int first_column = 0;
  int frame = 5;
  std::uint64_t time_ns = 1'000'000'000'000;
  std::uint64_t column_ns = 97'656;
  int first_measured = 0;  // of the 16
  int end_measured = 16;
  // By column of the packet, and row; in the units of the wire. second_ranges: of RNG19 dual.
  std::vector<std::vector<std::uint32_t>> ranges =
      std::vector<std::vector<std::uint32_t>>(16, std::vector<std::uint32_t>(128));
  std::vector<std::vector<std::uint32_t>> second_ranges = ranges;

  [[nodiscard]] bool is_legacy() const { return format == lidar::kFormat<lidar::OusterLegacy>; }

  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> out;
    const auto little = [&](std::uint64_t value, int size) {
      for (int i = 0; i < size; ++i) {
        out.push_back(static_cast<std::byte>(value >> (8 * i)));
      }
    };
    if (!is_legacy()) {
      little(1, 2);
      little(static_cast<std::uint64_t>(frame), 2);
      out.resize(32, std::byte{0x11});
    }
    for (int i = 0; i < 16; ++i) {
      const bool is_measured = i >= first_measured && i < end_measured;
      const int column = first_column + i;
      little(time_ns + static_cast<std::uint64_t>(i) * column_ns, 8);
      little(static_cast<std::uint64_t>(column), 2);
      if (is_legacy()) {
        little(static_cast<std::uint64_t>(frame), 2);
        little(static_cast<std::uint64_t>(column) * 90'112 /
                   static_cast<std::uint64_t>(columns_per_turn),
               4);
      } else {
        little(is_measured ? 1 : 0, 2);
      }
      for (int row = 0; row < rows; ++row) {
        const auto range_of = [&](const std::vector<std::vector<std::uint32_t>>& all) {
          return all[static_cast<std::size_t>(i)][static_cast<std::size_t>(row)];
        };
        if (format == lidar::kFormat<lidar::OusterRng15>) {
          little(range_of(ranges) | 0x1122'0000U, 4);  // near infrared, reflectivity
        } else if (format == lidar::kFormat<lidar::OusterRng19Dual>) {
          little(range_of(ranges) | 0x2200'0000U, 4);  // reflectivity
          little(range_of(second_ranges), 4);
          little(0x3344'5566, 4);  // signals
          little(0x5500'7788, 4);  // near infrared, window
        } else {
          little(range_of(ranges), 4);
          little(0x1122'3344'5566'7788, 8);  // reflectivity, signal, near infrared
        }
      }
      if (is_legacy()) {
        little(is_measured ? 0xFFFF'FFFF : 0, 4);
      }
    }
    if (!is_legacy()) {
      out.resize(out.size() + 32, std::byte{0x22});
    }
    return out;
  }
};

}  // namespace iog::tests
