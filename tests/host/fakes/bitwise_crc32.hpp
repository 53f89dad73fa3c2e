// CRC-32 bit by bit, straight from its parameters in the catalogue of parametrised CRC algorithms
// (G. Cook): reflected, begun with ones, inverted at the end. Without any code of the product's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::tests {

class BitwiseCrc32 {
 public:
  // Polynomials with their lowest power first.
  static constexpr std::uint32_t kIsoHdlc = 0xEDB88320;  // 0x04C11DB7, as in zlib
  static constexpr std::uint32_t kP4 = 0xC8DF352F;       // 0xF4ACFB13, of AUTOSAR's E2E profiles

  explicit BitwiseCrc32(std::uint32_t mirrored_polynomial = kIsoHdlc)
      : mirrored_polynomial_(mirrored_polynomial) {}

  BitwiseCrc32& add(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) {
      state_ ^= std::to_integer<std::uint32_t>(byte);
      for (int bit = 0; bit < 8; ++bit) {
        state_ = state_ >> 1 ^ ((state_ & 1U) != 0 ? mirrored_polynomial_ : 0U);
      }
    }
    return *this;
  }

  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t mirrored_polynomial_;
  std::uint32_t state_ = 0xFFFFFFFF;
};

}  // namespace iog::tests
