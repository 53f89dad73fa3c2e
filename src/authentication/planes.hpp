// Stores bytes in bit-sliced form. Plane b contains bit b of each of 32 bytes. These bytes are two
// AES blocks side by side. Logic operations on planes process all bytes at once. The run time of
// these operations does not depend on the values of the bytes.
//
// The byte in row r and column c of a block occupies bit 8 * r + 2 * c of each plane. The next
// higher bit belongs to a second block, which is always zero here. A row of the AES state therefore
// occupies one byte of each plane. Kaesper and Schwabe (Faster and Timing-Attack Resistant AES-GCM,
// 2009) use the same method with wider registers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "authentication/key.hpp"

namespace iog::authentication {

using Planes = std::array<std::uint32_t, 8>;

// Converts between a block and planes.
[[nodiscard]] Planes planes_of(std::span<const std::byte, kBlockBytes> block);
[[nodiscard]] Block block_of(const Planes& planes);

// Converts a single column, with the lowest byte first.
[[nodiscard]] Planes planes_of_column(std::uint32_t column);
[[nodiscard]] std::uint32_t column_of(const Planes& planes);

// Replaces each byte with its S-box entry (FIPS 197, SubBytes).
void substitute(Planes& planes);

}  // namespace iog::authentication
