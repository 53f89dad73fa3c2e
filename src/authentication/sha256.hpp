// Implements the hash function SHA-256 (FIPS 180-4).
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace iog::authentication {

inline constexpr std::size_t kSha256Bytes = 32;

// The message must be shorter than 2^29 bytes.
[[nodiscard]] std::array<std::byte, kSha256Bytes> sha256(std::span<const std::byte> message);

}  // namespace iog::authentication
