// Divides exactly, without a divide instruction, by a divisor known long before the dividend.
//
// The Cortex-A9 has no integer divide instruction, and every beam needs several divisions by the
// length of its line or by the sensor's precision. This class uses theorem 4.2 of Granlund and
// Montgomery, "Division by invariant integers using multiplication" (PLDI 1994). For a divisor `d`,
// let `l = ceil(log2(d))`, `s = N + l` and `m = ceil(2^s / d)`. Then the error `m * d - 2^s` is in
// the interval `[0, 2^l)`. It follows that `floor(n * m / 2^s) = floor(n / d)` for every integer
// `n` from 0 to `2^N - 1`.
//
// In this class, `N` is 31. If `d` is a power of two, `m` is 2^31. For any `d`, `m` is below 2^32
// because `d > 2^(l - 1)`. The product `n * m` is therefore below 2^63, so `2 * n * m` fits into 64
// bits. The upper 32-bit word of `2 * n * m` is `floor(n * m / 2^31)`.
#pragma once

#include <bit>
#include <cstdint>

namespace iog::numeric {

class Reciprocal {
 public:
  static constexpr int kDividendBits = 31;

  constexpr Reciprocal() = default;

  // Requires 1 <= divisor <= 2^31 - 1.
  explicit constexpr Reciprocal(std::uint32_t divisor)
      : log2_(static_cast<int>(std::bit_width(divisor - 1))),
        multiplier_(static_cast<std::uint32_t>(
            ((std::uint64_t{1} << (kDividendBits + log2_)) + divisor - 1) / divisor)) {}

  // Returns floor(dividend / divisor). Requires dividend < 2^31.
  [[nodiscard]] constexpr std::uint32_t divide(std::uint32_t dividend) const {
    const std::uint64_t product = std::uint64_t{dividend << 1U} * multiplier_;
    return static_cast<std::uint32_t>(product >> 32) >> log2_;
  }

 private:
  int log2_ = 0;
  std::uint32_t multiplier_ = std::uint32_t{1} << kDividendBits;
};

}  // namespace iog::numeric
