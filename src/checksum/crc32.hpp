// The two CRC-32 of this project. CMake chooses the way that is fast on the machine: crc32_neon.cpp
// or crc32_slices.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::checksum {

// A reflected CRC whose start and final xor are all ones. `kPolynomial` is written as in the
// standards, with the highest power first and without x^32. There are the two below.
template <std::uint32_t kPolynomial>
class FastCrc32 {
 public:
  void update(std::span<const std::byte> bytes);

  // The CRC of all bytes so far; more may follow.
  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = 0xFFFFFFFFU;
};

// CRC-32/ISO-HDLC, as in zlib: check value of "123456789" 0xCBF43926. It names grids and vehicles:
// any tool can compute it.
using Crc32 = FastCrc32<0x04C11DB7>;

// CRC-32/AUTOSAR: check value of "123456789" 0x1697D06A (AUTOSAR SWS CRCLibrary, CRC-32/P4).
using Crc32P4 = FastCrc32<0xF4ACFB13>;

}  // namespace iog::checksum
