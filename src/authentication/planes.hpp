// Bit-sliced bytes: plane b holds bit b of each of 32 bytes, two AES blocks side by side. Logic on
// planes processes all bytes at once, in a time independent of their values.
//
// Byte r of column c of a block is bit 8 r + 2 c of each plane. The bit above it belongs to a
// second block, which is zero here. A row of the state is therefore one byte of a plane (Kaesper
// and Schwabe, Faster and Timing-Attack Resistant AES-GCM, 2009, the same idea with wider
// registers).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "authentication/key.hpp"

namespace iog::authentication {

using Planes = std::array<std::uint32_t, 8>;

// Converts a block to planes and back.
[[nodiscard]] Planes planes_of(std::span<const std::byte, kBlockBytes> block);
[[nodiscard]] Block block_of(const Planes& planes);

// Converts a single column, lowest byte first.
[[nodiscard]] Planes planes_of_column(std::uint32_t column);
[[nodiscard]] std::uint32_t column_of(const Planes& planes);

// FIPS 197, SubBytes: replaces each byte by its S-box entry.
void substitute(Planes& planes);

}  // namespace iog::authentication
