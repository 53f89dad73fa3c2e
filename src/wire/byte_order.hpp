// Converts integers to and from wire bytes. Byte order is handled only in this file.
//
// Each function takes a span that is exactly as long as the integer:
//     load_be16(frame.subspan<12, 2>())
// If `frame` has a static extent and is too short, the code does not compile. If the extent is
// dynamic, the caller must ensure that `frame` is long enough. ByteReader and ByteWriter check the
// length.
//
// ARMv7 supports unaligned access to normal memory, so GCC merges the bytewise expressions into one
// ldr/str and one rev.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::wire {

[[nodiscard]] constexpr std::uint8_t load_u8(std::span<const std::byte, 1> bytes) {
  return std::to_integer<std::uint8_t>(bytes[0]);
}

[[nodiscard]] constexpr std::uint16_t load_be16(std::span<const std::byte, 2> bytes) {
  return static_cast<std::uint16_t>(std::to_integer<std::uint32_t>(bytes[0]) << 8 |
                                    std::to_integer<std::uint32_t>(bytes[1]));
}

[[nodiscard]] constexpr std::uint16_t load_le16(std::span<const std::byte, 2> bytes) {
  return static_cast<std::uint16_t>(std::to_integer<std::uint32_t>(bytes[1]) << 8 |
                                    std::to_integer<std::uint32_t>(bytes[0]));
}

[[nodiscard]] constexpr std::uint32_t load_be32(std::span<const std::byte, 4> bytes) {
  return std::to_integer<std::uint32_t>(bytes[0]) << 24 |
         std::to_integer<std::uint32_t>(bytes[1]) << 16 |
         std::to_integer<std::uint32_t>(bytes[2]) << 8 | std::to_integer<std::uint32_t>(bytes[3]);
}

[[nodiscard]] constexpr std::uint32_t load_le32(std::span<const std::byte, 4> bytes) {
  return std::to_integer<std::uint32_t>(bytes[3]) << 24 |
         std::to_integer<std::uint32_t>(bytes[2]) << 16 |
         std::to_integer<std::uint32_t>(bytes[1]) << 8 | std::to_integer<std::uint32_t>(bytes[0]);
}

[[nodiscard]] constexpr std::uint64_t load_be64(std::span<const std::byte, 8> bytes) {
  return std::uint64_t{load_be32(bytes.first<4>())} << 32 | load_be32(bytes.last<4>());
}

[[nodiscard]] constexpr std::uint64_t load_le64(std::span<const std::byte, 8> bytes) {
  return std::uint64_t{load_le32(bytes.last<4>())} << 32 | load_le32(bytes.first<4>());
}

constexpr void store_u8(std::span<std::byte, 1> bytes, std::uint8_t value) {
  bytes[0] = std::byte{value};
}

constexpr void store_be16(std::span<std::byte, 2> bytes, std::uint16_t value) {
  bytes[0] = static_cast<std::byte>(value >> 8);
  bytes[1] = static_cast<std::byte>(value);
}

constexpr void store_le16(std::span<std::byte, 2> bytes, std::uint16_t value) {
  bytes[0] = static_cast<std::byte>(value);
  bytes[1] = static_cast<std::byte>(value >> 8);
}

constexpr void store_be32(std::span<std::byte, 4> bytes, std::uint32_t value) {
  bytes[0] = static_cast<std::byte>(value >> 24);
  bytes[1] = static_cast<std::byte>(value >> 16);
  bytes[2] = static_cast<std::byte>(value >> 8);
  bytes[3] = static_cast<std::byte>(value);
}

constexpr void store_le32(std::span<std::byte, 4> bytes, std::uint32_t value) {
  bytes[0] = static_cast<std::byte>(value);
  bytes[1] = static_cast<std::byte>(value >> 8);
  bytes[2] = static_cast<std::byte>(value >> 16);
  bytes[3] = static_cast<std::byte>(value >> 24);
}

constexpr void store_be64(std::span<std::byte, 8> bytes, std::uint64_t value) {
  store_be32(bytes.first<4>(), static_cast<std::uint32_t>(value >> 32));
  store_be32(bytes.last<4>(), static_cast<std::uint32_t>(value));
}

constexpr void store_le64(std::span<std::byte, 8> bytes, std::uint64_t value) {
  store_le32(bytes.first<4>(), static_cast<std::uint32_t>(value));
  store_le32(bytes.last<4>(), static_cast<std::uint32_t>(value >> 32));
}

}  // namespace iog::wire
