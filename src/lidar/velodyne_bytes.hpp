// Where the bytes of a Velodyne data packet stand, and what they can be (docs/spec.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "wire/byte_order.hpp"

namespace iog::lidar::velodyne {

inline constexpr std::size_t kTimeOffset = 1200;
inline constexpr std::size_t kModeOffset = 1204;
inline constexpr std::size_t kProductOffset = 1205;
inline constexpr std::uint16_t kBlockFlag = 0xEEFF;
inline constexpr std::uint16_t kLowerFlag = 0xDDFF;  // the lower bank of an HDL-64E
inline constexpr std::uint8_t kModeStrongest = 0x37;
inline constexpr std::uint8_t kModeLast = 0x38;
inline constexpr std::uint8_t kModeDual = 0x39;
inline constexpr std::uint8_t kProductHdl32e = 0x21;  // and VLP-16 before firmware 3.0.29
inline constexpr std::uint8_t kProductVlp16 = 0x22;
inline constexpr std::uint8_t kProductVlp32c = 0x28;

inline std::uint16_t word_at(std::span<const std::byte> packet, std::size_t offset) {
  return wire::load_le16(packet.subspan(offset).first<2>());
}

inline std::uint8_t byte_at(std::span<const std::byte> packet, std::size_t offset) {
  return wire::load_u8(packet.subspan(offset).first<1>());
}

}  // namespace iog::lidar::velodyne
