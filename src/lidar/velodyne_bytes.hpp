// The byte offsets and byte values of a Velodyne data packet (docs/spec.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "wire/byte_order.hpp"

namespace iog::lidar::velodyne {

inline constexpr std::size_t kPacketBytes = 1206;
inline constexpr std::size_t kBlocks = 12;
inline constexpr std::size_t kBlockBytes = 100;
inline constexpr std::uint32_t kTurn = 36'000;  // 0.01 degrees
inline constexpr std::uint32_t kHourUs = 3'600'000'000U;
inline constexpr std::size_t kTimeOffset = 1200;
inline constexpr std::size_t kModeOffset = 1204;
inline constexpr std::size_t kProductOffset = 1205;
inline constexpr std::uint16_t kBlockFlag = 0xEEFF;
// The flags of the banks, in order. An HDL-64E has two banks, and a VLS-128 has four.
inline constexpr std::array<std::uint16_t, 4> kBankFlags{kBlockFlag, 0xDDFF, 0xCCFF, 0xBBFF};
inline constexpr std::uint8_t kModeStrongest = 0x37;
inline constexpr std::uint8_t kModeLast = 0x38;
inline constexpr std::uint8_t kModeDual = 0x39;
inline constexpr std::uint8_t kProductHdl32e = 0x21;  // also a VLP-16 with firmware before 3.0.29
inline constexpr std::uint8_t kProductVlp16 = 0x22;
inline constexpr std::uint8_t kProductPuckHires = 0x24;
inline constexpr std::uint8_t kProductVlp32c = 0x28;
inline constexpr std::uint8_t kProductVls128 = 0xA1;
inline constexpr std::uint8_t kProductVls128ByManual = 0x63;

inline std::uint16_t word_at(std::span<const std::byte> packet, std::size_t offset) {
  return wire::load_le16(packet.subspan(offset).first<2>());
}

inline std::uint8_t byte_at(std::span<const std::byte> packet, std::size_t offset) {
  return wire::load_u8(packet.subspan(offset).first<1>());
}

// Returns the clockwise angle from one azimuth to another. The heads rotate clockwise.
constexpr std::uint32_t gained(std::uint32_t from, std::uint32_t to) {
  return (to + kTurn - from) % kTurn;
}

}  // namespace iog::lidar::velodyne
