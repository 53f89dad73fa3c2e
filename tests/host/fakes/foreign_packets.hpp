// Packets of lidars that are not taken, byte by byte as their makers describe the beginnings of
// theirs; what a header does not name is left 0.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "fakes/velodyne_packet.hpp"

namespace iog::tests {

inline void put(std::vector<std::byte>& bytes, std::size_t at, std::initializer_list<int> values) {
  std::ranges::transform(values, bytes.begin() + static_cast<std::ptrdiff_t>(at),
                         [](int value) { return static_cast<std::byte>(value); });
}

// VLS-128 User Manual (63-9483), "Packet structure": with two returns, which are not taken, each
// bank of 32 lasers comes twice.
inline std::vector<std::byte> vls128_packet() {
  auto bytes = VelodynePacket{.mode = 0x39, .product = 0xA1, .blocks_of_azimuth = 8}.bytes();
  for (std::size_t block = 0; block < 12; ++block) {
    put(bytes, 100 * block, {0xFF, 0xEE - static_cast<int>(block / 2 % 4) * 0x11});
  }
  return bytes;
}

// Hesai's later units, "Pre-header" and "Header": start, protocol, lasers, blocks, unit of range.
inline std::vector<std::byte> hesai_header_packet(int major, int minor, int lasers, int blocks,
                                                  std::size_t size) {
  std::vector<std::byte> bytes(size);
  put(bytes, 0, {0xEE, 0xFF, major, minor, 0, 0, lasers, blocks, 0, 4, 1, 0});
  return bytes;
}

// RS-LiDAR-16 User Guide, "MSOP": header, 12 blocks, index and tail.
inline std::vector<std::byte> robosense_packet() {
  std::vector<std::byte> bytes(1248);
  put(bytes, 0, {0x55, 0xAA, 0x05, 0x0A, 0x5A, 0xA5, 0x50, 0xA0});
  return bytes;
}

struct ForeignPacket {
  std::string_view name;
  std::vector<std::byte> bytes;
};

inline std::vector<ForeignPacket> foreign_packets() {
  return {{"Velodyne VLS-128", vls128_packet()},
          {"Hesai Pandar128 or OT128", hesai_header_packet(1, 4, 128, 2, 893)},
          {"RoboSense RS-16, RS-32 or Bpearl", robosense_packet()}};
}

}  // namespace iog::tests
