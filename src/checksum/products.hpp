// Carry-less products of bytes, eight at a time: what the Cortex-A9 multiplies in one instruction.
//
// The same on every machine, bit for bit: NEON on the target and plain C++ elsewhere, which is the
// specification (tests/host/checksum/products_test.cpp compares).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#if defined(__ARM_NEON)
#include <arm_neon.h>
#endif

namespace iog::checksum {

inline constexpr std::size_t kProductLanes = 8;
inline constexpr std::size_t kFactorBytes = 4;

// A factor of 32 bits for each of eight bytes, as the machine loads them: byte by byte, lowest
// first.
struct alignas(16) Factors {
  std::array<std::array<std::uint8_t, kProductLanes>, kFactorBytes> bytes{};

  constexpr void set(std::size_t lane, std::uint32_t factor) {
    for (std::size_t i = 0; i < kFactorBytes; ++i) {
      bytes[i][lane] = static_cast<std::uint8_t>(factor >> (8 * i));
    }
  }
};

// The sum, without carry, of bytes times their factors: 8 + 32 - 1 = 39 bits.
class PlainProducts {
 public:
  void add(std::span<const std::byte, kProductLanes> bytes, const Factors& factors) {
    for (std::size_t lane = 0; lane < kProductLanes; ++lane) {
      for (std::size_t i = 0; i < kFactorBytes; ++i) {
        for (unsigned bit = 0; bit < 8; ++bit) {
          const std::uint64_t factor = factors.bytes[i][lane];
          const bool is_set = (std::to_integer<unsigned>(bytes[lane]) >> bit & 1U) != 0;
          sum_ ^= is_set ? factor << (8 * i + bit) : 0U;
        }
      }
    }
  }

  [[nodiscard]] std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
};

#if defined(__ARM_NEON)

inline constexpr bool kHasProducts = true;

// One sum of 16 bits for each lane and byte of the factors; they are put together in the end.
class Products {
 public:
  void add(std::span<const std::byte, kProductLanes> bytes, const Factors& factors) {
    const auto* const from = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const poly8x8_t left = vreinterpret_p8_u8(vld1_u8(from));
    for (std::size_t i = 0; i < kFactorBytes; i += 2) {
      const poly8x16_t right = vreinterpretq_p8_u8(vld1q_u8(factors.bytes[i].data()));
      add_product(i, left, vget_low_p8(right));
      add_product(i + 1, left, vget_high_p8(right));
    }
  }

  // Columns of the four by four sums become rows, so that adding the rows adds the lanes.
  [[nodiscard]] std::uint64_t sum() const {
    const uint16x4x2_t low = vtrn_u16(lanes_added(0), lanes_added(1));
    const uint16x4x2_t high = vtrn_u16(lanes_added(2), lanes_added(3));
    const auto words = [](uint16x4_t row) { return vreinterpret_u32_u16(row); };
    const uint32x2x2_t even = vtrn_u32(words(low.val[0]), words(high.val[0]));
    const uint32x2x2_t odd = vtrn_u32(words(low.val[1]), words(high.val[1]));
    const uint32x2_t all =
        veor_u32(veor_u32(even.val[0], even.val[1]), veor_u32(odd.val[0], odd.val[1]));
    const std::uint32_t lower = vget_lane_u32(all, 0);
    const std::uint32_t upper = vget_lane_u32(all, 1);
    return std::uint64_t{(lower & 0xFFFFU) ^ (lower >> 16 << 8)} ^
           (std::uint64_t{(upper & 0xFFFFU) ^ (upper >> 16 << 8)} << 16);
  }

 private:
  void add_product(std::size_t i, poly8x8_t left, poly8x8_t right) {
    sums_[i] = veorq_u16(sums_[i], vreinterpretq_u16_p16(vmull_p8(left, right)));
  }
  [[nodiscard]] uint16x4_t lanes_added(std::size_t i) const {
    return veor_u16(vget_low_u16(sums_[i]), vget_high_u16(sums_[i]));
  }

  std::array<uint16x8_t, kFactorBytes> sums_{};
};

#else

inline constexpr bool kHasProducts = false;
using Products = PlainProducts;

#endif

}  // namespace iog::checksum
