// Divides exactly without a divide instruction, for a divisor that is known long before the
// dividend.
//
// The Cortex-A9 has no integer divide instruction, and every beam needs several divisions by the
// sensor's range. This class uses theorem 4.2 of Granlund and Montgomery, "Division by invariant
// integers using multiplication" (PLDI 1994). For a divisor d, let l = ceil(log2(d)), s = N + l and
// m = ceil(2^s / d). Then the error m * d - 2^s is in [0, 2^l). For every 0 <= n < 2^N, it follows
// that floor(n * m / 2^s) = floor(n / d).
//
// In this class, N = 31. The inequality d > 2^(l - 1) implies m < 2^32. If d is a power of two,
// m = 2^31. The product n * m is therefore below 2^63, and the 32 x 32-bit product does not
// overflow. The quotient n * m / 2^31 fits into one word, which is the upper word of
// 2 * n * m.
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
