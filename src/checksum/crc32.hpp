// Declares the two CRC-32 variants of this project. CMake selects the fastest of three
// implementations for the machine: crc32_neon.cpp, crc32_pclmul.cpp or crc32_slices.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::checksum {

// A reflected CRC-32. The initial value and the final xor are all ones. `kPolynomial` uses the
// notation of the standards, with the highest power first and x^32 omitted. Both instances are
// defined below.
template <std::uint32_t kPolynomial>
class FastCrc32 {
 public:
  void update(std::span<const std::byte> bytes);

  // Returns the contribution of a part to the CRC. A part's contribution does not depend on the
  // preceding bytes, so several cores can process different parts in parallel.
  static constexpr std::size_t kPartBytes = 1024;
  using Part = std::span<const std::byte, kPartBytes>;
  [[nodiscard]] static std::uint32_t remainder_of(Part part) {
    FastCrc32 crc;
    crc.state_ = 0;
    crc.update(part);
    return crc.state_;
  }
  // Equivalent to calling update() with a part whose remainder is `remainder`.
  void add_remainder(std::uint32_t remainder) { state_ = after_zeros(state_, 0) ^ remainder; }
  // Equivalent to update(before), followed by update() with a part whose remainder is `remainder`.
  template <std::size_t kBefore>
  void add_remainder(std::span<const std::byte, kBefore> before, std::uint32_t remainder) {
    static_assert(kBefore <= kMostBefore);
    for (std::size_t i = 0; i < kBefore; ++i) {
      state_ ^= std::to_integer<std::uint32_t>(before[i]) << (8 * i);
    }
    state_ = after_zeros(state_, kBefore) ^ remainder;
  }

  // The same for any number of bytes. Fastest for 8 to 128 bytes, such as the head of a message.
  void add_remainder(std::span<const std::byte> before, std::uint32_t remainder);

  // Returns the CRC of all bytes so far. Further calls to update() are allowed.
  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  static constexpr std::size_t kMostBefore = 4;
  static constexpr std::size_t kMostBytesBefore = 128;

  // Returns the state after `before + kPartBytes` zero bytes.
  static std::uint32_t after_zeros(std::uint32_t state, std::size_t before);

  std::uint32_t state_ = 0xFFFFFFFFU;
};

// CRC-32/ISO-HDLC, as used by zlib. The check value of "123456789" is 0xCBF43926. Grids and cars
// are identified with this CRC because any tool can compute it.
using Crc32 = FastCrc32<0x04C11DB7>;

// CRC-32/AUTOSAR (AUTOSAR SWS CRCLibrary, CRC-32/P4). The check value of "123456789" is 0x1697D06A.
using Crc32P4 = FastCrc32<0xF4ACFB13>;

}  // namespace iog::checksum
