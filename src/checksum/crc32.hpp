// The two CRC-32 variants of this project. CMake chooses the faster implementation for the machine:
// crc32_neon.cpp, crc32_pclmul.cpp or crc32_slices.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::checksum {

// A reflected CRC with initial value and final xor of all ones. `kPolynomial` has the notation of
// the standards: highest power first and without x^32. The two instances are below.
template <std::uint32_t kPolynomial>
class FastCrc32 {
 public:
  void update(std::span<const std::byte> bytes);

  // The contribution of a part to the CRC. It does not depend on the preceding bytes, so several
  // cores can compute the contributions of different parts.
  static constexpr std::size_t kPartBytes = 1024;
  using Part = std::span<const std::byte, kPartBytes>;
  [[nodiscard]] static std::uint32_t remainder_of(Part part) {
    FastCrc32 crc;
    crc.state_ = 0;
    crc.update(part);
    return crc.state_;
  }
  // Has the same effect as update() with a part that has this remainder.
  void add_remainder(std::uint32_t remainder) { state_ = after_zeros(state_, 0) ^ remainder; }
  // Has the same effect as update() with `before` and then with such a part.
  template <std::size_t kBefore>
  void add_remainder(std::span<const std::byte, kBefore> before, std::uint32_t remainder) {
    static_assert(kBefore <= kMostBefore);
    for (std::size_t i = 0; i < kBefore; ++i) {
      state_ ^= std::to_integer<std::uint32_t>(before[i]) << (8 * i);
    }
    state_ = after_zeros(state_, kBefore) ^ remainder;
  }

  // The CRC of all bytes so far. More bytes may follow.
  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  static constexpr std::size_t kMostBefore = 4;

  // The state after `before` zero bytes, followed by a part of zero bytes.
  static std::uint32_t after_zeros(std::uint32_t state, std::size_t before);

  std::uint32_t state_ = 0xFFFFFFFFU;
};

// CRC-32/ISO-HDLC, as in zlib: check value of "123456789" 0xCBF43926. It is used to identify grids
// and cars, because any tool can compute it.
using Crc32 = FastCrc32<0x04C11DB7>;

// CRC-32/AUTOSAR: check value of "123456789" 0x1697D06A (AUTOSAR SWS CRCLibrary, CRC-32/P4).
using Crc32P4 = FastCrc32<0xF4ACFB13>;

}  // namespace iog::checksum
