// Bytes by their bits: plane b holds bit b of each of 32 bytes, which are two blocks of AES side by
// side. Logic on planes is logic on all of the bytes at once, and takes as long whatever they are.
//
// Byte r of column c of a block is bit 8 r + 2 c of each plane; the bit above it is of a second
// block, which is zeros here. So a row of the state is a byte of a plane (Kaesper and Schwabe,
// Faster and Timing-Attack Resistant AES-GCM, 2009, the same idea with wider registers).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "authentication/key.hpp"

namespace iog::authentication {

using Planes = std::array<std::uint32_t, 8>;

// A block's planes, and the block of planes.
[[nodiscard]] Planes planes_of(std::span<const std::byte, kBlockBytes> block);
[[nodiscard]] Block block_of(const Planes& planes);

// The same of a column alone, the lowest byte first.
[[nodiscard]] Planes planes_of_column(std::uint32_t column);
[[nodiscard]] std::uint32_t column_of(const Planes& planes);

// FIPS 197, SubBytes: each byte becomes its entry in the S-box.
void substitute(Planes& planes);

}  // namespace iog::authentication
