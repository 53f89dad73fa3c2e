// MAVLink 2 messages DISTANCE_SENSOR, with what a test wants in them. The checksum is computed bit
// by bit of what the standard says of it, not by the code under test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "wire/byte_writer.hpp"

namespace iog::tests {

// CRC-16/MCRF4XX of the message from its second byte on, and of the number of its layout.
inline std::uint16_t mavlink_checksum(std::span<const std::byte> message, std::uint8_t layout) {
  std::vector<std::byte> bytes(message.begin() + 1, message.end());
  bytes.push_back(std::byte{layout});
  // As a division of polynomials: each byte's least bit is the highest power.
  unsigned remainder = 0xFFFF;
  for (const std::byte byte : bytes) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      const bool is_odd = ((remainder >> 15 ^ std::to_integer<unsigned>(byte) >> bit) & 1U) != 0;
      remainder = (remainder << 1 & 0xFFFF) ^ (is_odd ? 0x1021U : 0U);
    }
  }
  unsigned mirrored = 0;
  for (unsigned bit = 0; bit < 16; ++bit) {
    mirrored |= (remainder >> bit & 1U) << (15 - bit);
  }
  return static_cast<std::uint16_t>(mirrored);
}

struct MavlinkDistance {
  std::uint32_t time_ms = 123'456;
  std::uint16_t least_cm = 20;
  std::uint16_t most_cm = 765;
  std::uint16_t current_cm = 187;
  std::uint8_t kind = 1;
  std::uint8_t number = 3;
  std::uint8_t orientation = 0;
  std::uint8_t variance = 4;
  std::uint8_t quality = 0;
  std::uint8_t sequence = 7;
  std::uint8_t flags = 0;
  std::uint32_t message = 132;
  std::uint8_t layout = 85;

  [[nodiscard]] std::vector<std::byte> bytes() const {
    std::vector<std::byte> payload(39);
    wire::ByteWriter in(payload);
    in.u32_le(time_ms);
    in.u16_le(least_cm);
    in.u16_le(most_cm);
    in.u16_le(current_cm);
    in.u8(kind);
    in.u8(number);
    in.u8(orientation);
    in.u8(variance);
    in.zeros(24);
    in.u8(quality);
    while (payload.size() > 1 && payload.back() == std::byte{0}) {
      payload.pop_back();
    }
    std::vector<std::byte> all(10 + payload.size() + 2);
    wire::ByteWriter out(all);
    out.u8(0xFD);
    out.u8(static_cast<std::uint8_t>(payload.size()));
    out.u8(flags);
    out.u8(0);
    out.u8(sequence);
    out.u8(1);
    out.u8(1);
    out.u8(static_cast<std::uint8_t>(message & 0xFFU));
    out.u16_le(static_cast<std::uint16_t>(message >> 8));
    out.bytes(payload);
    out.u16_le(mavlink_checksum(out.written(), layout));
    return all;
  }
};

}  // namespace iog::tests
