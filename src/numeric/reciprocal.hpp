// Exact division by a divisor that is known long before the dividend, without a divide instruction.
//
// The Cortex-A9 has no integer divide, and every beam divides several times by its sensor's range.
// Granlund and Montgomery, "Division by invariant integers using multiplication" (PLDI 1994),
// theorem 4.2: with l = ceil(log2 d), s = N + l and m = ceil(2^s / d), the error m*d - 2^s lies in
// [0, 2^l), therefore floor(n * m / 2^s) = floor(n / d) for every 0 <= n < 2^N.
//
// Here N = 31, so m <= 2^32 and n * m < 2^63: one 64-bit product, no overflow.
#pragma once

#include <bit>
#include <cstdint>

namespace iog::numeric {

class Reciprocal {
 public:
  static constexpr int kDividendBits = 31;

  constexpr Reciprocal() = default;

  // divisor: 1 ... 2^31 - 1.
  explicit constexpr Reciprocal(std::uint32_t divisor)
      : shift_(kDividendBits + static_cast<int>(std::bit_width(divisor - 1))),
        multiplier_(((std::uint64_t{1} << shift_) + divisor - 1) / divisor) {}

  // floor(dividend / divisor) for dividend < 2^31.
  [[nodiscard]] constexpr std::uint32_t divide(std::uint32_t dividend) const {
    return static_cast<std::uint32_t>((dividend * multiplier_) >> shift_);
  }

 private:
  int shift_ = kDividendBits;
  std::uint64_t multiplier_ = std::uint64_t{1} << kDividendBits;
};

}  // namespace iog::numeric
