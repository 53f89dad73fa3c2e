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
  Lanes() = default;
  Lanes(poly8x8_t bytes, const Factors& factors) { add(bytes, factors); }

  void add(poly8x8_t bytes, const Factors& factors) {
    const Factors* next = &factors;
    add(bytes, lanes::load_next_pair(next));
  }
  void add(poly8x8_t bytes, poly8x16x2_t factors) {
    add_product(0, bytes, vget_low_p8(factors.val[0]));
    add_product(1, bytes, vget_high_p8(factors.val[0]));
    add_product(2, bytes, vget_low_p8(factors.val[1]));
    add_product(3, bytes, vget_high_p8(factors.val[1]));
  }

  // Returns four sums of 16 bits, one for each byte of the factors. Transposes the four by four
  // sums, so that adding the rows adds the lanes.
  [[nodiscard]] uint32x2_t rows() const {
    const uint16x4x2_t low = vtrn_u16(lanes_added(0), lanes_added(1));
    const uint16x4x2_t high = vtrn_u16(lanes_added(2), lanes_added(3));
    const auto words = [](uint16x4_t row) { return vreinterpret_u32_u16(row); };
    const uint32x2x2_t even = vtrn_u32(words(low.val[0]), words(high.val[0]));
    const uint32x2x2_t odd = vtrn_u32(words(low.val[1]), words(high.val[1]));
    return veor_u32(veor_u32(even.val[0], even.val[1]), veor_u32(odd.val[0], odd.val[1]));
  }
  [[nodiscard]] std::uint64_t sum() const {
    const uint32x2_t all = rows();
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
  // The bytes of the rows of the first half are joined without being added to each other before.
  static std::uint64_t of_halves(std::uint32_t state, const std::byte* first,
                                 const std::byte* second, std::span<const Factors> factors,
                                 const Factors& join) {
    Lanes of_first(vreinterpret_p8_u32(vset_lane_u32(state, vdup_n_u32(0), 0)), factors.front());
    Lanes of_second;
    const Factors* next = factors.data();
    for (const Factors* const end = next + factors.size(); next != end;) {
      const poly8x16x2_t of_eight = lanes::load_next_pair(next);
      of_first.add(lanes::load_next_eight(first), of_eight);
      of_second.add(lanes::load_next_eight(second), of_eight);
    }
    of_second.add(vreinterpret_p8_u32(of_first.rows()), join);
    return of_second.sum();
  }

  static std::uint64_t of_all(std::uint64_t eight, const std::byte* bytes,
                              std::span<const Factors> factors) {
    Lanes sums(vcreate_p8(eight), factors.front());
    const Factors* next = &factors.front() + 1;
    for (const Factors* const end = factors.data() + factors.size(); next != end;) {
      sums.add(lanes::load_next_eight(bytes), lanes::load_next_pair(next));
    }
    return sums.sum();
  }

  static std::uint64_t of(std::uint64_t bytes, const Factors& factors) {
    return Lanes(vcreate_p8(bytes), factors).sum();
  }
};

}  // namespace

// Not inlined, because its callers would save the registers of the loop, too.
template <std::uint32_t kPolynomial>
[[gnu::noinline]] void FastCrc32<kPolynomial>::update(std::span<const std::byte> bytes) {
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

template <std::uint32_t kPolynomial>
void FastCrc32<kPolynomial>::add_remainder(std::span<const std::byte> before,
                                           std::uint32_t remainder) {
  using Products = ProductCrc32<kPolynomial, NeonProducts>;
  if (before.size() < kProductLanes || before.size() > kMostBytesBefore) {
    update(before);
    add_remainder(remainder);
  } else {
    state_ =
        Products::template after_zeros<kPartBytes, kMostBytesBefore>(state_, before) ^ remainder;
  }
}

template class FastCrc32<0x04C11DB7>;
template class FastCrc32<0xF4ACFB13>;

}  // namespace iog::checksum
