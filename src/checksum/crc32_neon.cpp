// NEON multiplies eight pairs of bytes without carry in one instruction. On the Cortex-A9 a tile of
// 1 KiB takes 1.6 cycles a byte, against 2.4 with look-ups (modelled as in docs/a9_model.md).
#include <arm_neon.h>
#include <array>

#include "checksum/crc32.hpp"
#include "checksum/product_crc32.hpp"
#include "checksum/products.hpp"
#include "lanes/moves_neon.hpp"

namespace iog::checksum {
namespace {

// A 16-bit sum for each lane and each byte of the factors.
class Lanes {
 public:
  void add(poly8x8_t bytes, poly8x16_t low_factors, poly8x16_t high_factors) {
    add_product(0, bytes, vget_low_p8(low_factors));
    add_product(1, bytes, vget_high_p8(low_factors));
    add_product(2, bytes, vget_low_p8(high_factors));
    add_product(3, bytes, vget_high_p8(high_factors));
  }

  // Transposes the four by four sums, so that adding the rows adds the lanes.
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

// The NEON twin of PlainProducts.
class NeonProducts {
 public:
  using Sums = PlainProducts::Sums;

  static Sums of_halves(const std::byte* first, const std::byte* second,
                        std::span<const Factors> factors) {
    Lanes of_first;
    Lanes of_second;
    const Factors* next = factors.data();
    for (const Factors* const end = next + factors.size(); next != end;) {
      const poly8x16x2_t of_eight = lanes::load_next_pair(next);
      of_first.add(lanes::load_next_eight(first), of_eight.val[0], of_eight.val[1]);
      of_second.add(lanes::load_next_eight(second), of_eight.val[0], of_eight.val[1]);
    }
    return {.first = of_first.sum(), .second = of_second.sum()};
  }

  static std::uint64_t of(std::span<const std::byte, kProductLanes> bytes, const Factors& factors) {
    Lanes lanes;
    const std::byte* from = bytes.data();
    const Factors* next = &factors;
    const poly8x16x2_t of_eight = lanes::load_next_pair(next);
    lanes.add(lanes::load_next_eight(from), of_eight.val[0], of_eight.val[1]);
    return lanes.sum();
  }
};

}  // namespace

template <std::uint32_t kPolynomial>
void FastCrc32<kPolynomial>::update(std::span<const std::byte> bytes) {
  ProductCrc32<kPolynomial, NeonProducts> crc;
  crc.set_state(state_);
  crc.update(bytes);
  state_ = crc.state();
}

template <std::uint32_t kPolynomial>
std::uint32_t FastCrc32<kPolynomial>::after_zeros(std::uint32_t state, std::size_t before) {
  using Products = ProductCrc32<kPolynomial, NeonProducts>;
  return Products::template after_zeros<kPartBytes, kMostBefore>(state, before);
}

template class FastCrc32<0x04C11DB7>;
template class FastCrc32<0xF4ACFB13>;

}  // namespace iog::checksum
