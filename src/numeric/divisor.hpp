// Divides exactly, without a divide instruction, by a divisor known only at run time.
//
// The Cortex-A9 has no integer divide instruction, and the compiler's 64-bit division takes about
// 400 instructions. This class follows Moeller and Granlund, "Improved division by invariant
// integers" (IEEE Transactions on Computers 60, 2011). The divisor `d` is first shifted left until
// its top bit is set. Algorithm 2 then computes
//     inverse = floor((2^64 - 1) / d) - 2^32
// from a table of 512 entries and two Newton steps. Algorithm 4 divides a 64-bit dividend by `d`
// with one multiplication by the inverse and two corrections. All operations may wrap around. The
// paper proves that the result is correct even after a wrap-around.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace iog::numeric {

namespace divisor_detail {

using Inverses = std::array<std::uint16_t, 512>;

consteval Inverses make_inverses() {
  Inverses inverses{};
  for (std::uint32_t i = 0; i < inverses.size(); ++i) {
    inverses[i] = static_cast<std::uint16_t>(((1U << 24) - (1U << 14) + (1U << 9)) / (512 + i));
  }
  return inverses;
}

// Each entry is `floor((2^24 - 2^14 + 2^9) / u)`, where `u` is the value of the upper ten bits of
// the divisor. The index of an entry is `u` without its top bit. The table is global because the
// compiler would otherwise copy it to the stack in each call.
inline constexpr Inverses kInverses = make_inverses();

}  // namespace divisor_detail

class Divisor {
 public:
  // Requires divisor > 0.
  explicit constexpr Divisor(std::uint32_t divisor)
      : shift_(std::countl_zero(divisor)),
        divisor_(divisor << shift_),
        inverse_(inverse_of(divisor_)) {}

  // Returns floor(dividend / divisor). The quotient must be below 2^32.
  [[nodiscard]] constexpr std::uint32_t divide(std::uint64_t dividend) const {
    const std::uint64_t shifted = dividend << shift_;
    const std::uint64_t estimate = (shifted >> 32) * inverse_ + shifted;
    std::uint32_t quotient = static_cast<std::uint32_t>(estimate >> 32) + 1;
    std::uint32_t rest = static_cast<std::uint32_t>(shifted) - quotient * divisor_;
    if (rest > static_cast<std::uint32_t>(estimate)) {
      --quotient;
      rest += divisor_;
    }
    return rest >= divisor_ ? quotient + 1 : quotient;
  }

 private:
  static constexpr std::uint32_t high(std::uint64_t product) {
    return static_cast<std::uint32_t>(product >> 32);
  }

  // Implements algorithm 2. Requires d >= 2^31.
  static constexpr std::uint32_t inverse_of(std::uint32_t d) {
    const std::uint32_t v0 = divisor_detail::kInverses[(d >> 22) - 512];
    const std::uint32_t square = v0 * v0;  // below 2^30
    const std::uint32_t v1 = 16 * v0 - high(std::uint64_t{square} * ((d >> 11) + 1)) - 1;
    const std::uint32_t e = (v1 / 2 & (0 - (d & 1U))) - v1 * (d / 2 + (d & 1U));
    const std::uint32_t v2 = (v1 << 15) + (high(std::uint64_t{v1} * e) >> 1);
    return v2 - high(std::uint64_t{v2} * d + d) - d;
  }

  int shift_;
  std::uint32_t divisor_;
  std::uint32_t inverse_;
};

}  // namespace iog::numeric
