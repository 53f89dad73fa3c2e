// The NEON version of evidence_bits.cpp. It handles two rows at once and adds their bits by pairs
// of lanes.
#include <arm_neon.h>

#include "placing/evidence_bits.hpp"
#include "placing/slice_byte.hpp"

namespace iog::placing {
namespace {

constexpr std::size_t kLanes = 16;
constexpr std::size_t kSide = geometry::kTileSide;

// Two rows in four halves.
struct TwoRows {
  std::array<int8x16_t, 4> halves;

  // is_it(cells) must set all bits of the lanes that count.
  template <typename IsIt>
  void put(IsIt is_it, std::uint32_t* words) const {
    const uint8x8_t own = vcreate_u8(0x8040'2010'0804'0201U);
    const auto sums = [&](std::size_t i) {
      const uint8x16_t bits = vandq_u8(is_it(halves[i]), vcombine_u8(own, own));
      return vpadd_u8(vget_low_u8(bits), vget_high_u8(bits));
    };
    const uint8x8_t first = vpadd_u8(sums(0), sums(1));
    const uint8x8_t second = vpadd_u8(sums(2), sums(3));
    vst1_u32(words, vreinterpret_u32_u8(vpadd_u8(first, second)));
  }
};

}  // namespace

EvidenceBits bits_of(const FrameEvidence::TileIndexes& tile) {
  EvidenceBits bits;
  const int8x16_t zero = vdupq_n_s8(0);
  const int8x16_t high = vdupq_n_s8(-kMostIndex);
  for (std::size_t y = 0; y < kSide; y += 2) {
    const std::int8_t* const cells = &tile[y * kSide];
    const TwoRows rows{{vld1q_s8(cells), vld1q_s8(cells + kLanes), vld1q_s8(cells + 2 * kLanes),
                        vld1q_s8(cells + 3 * kLanes)}};
    rows.put([zero](int8x16_t its) { return vcgtq_s8(its, zero); }, &bits.hit[y]);
    rows.put([zero](int8x16_t its) { return vcltq_s8(its, zero); }, &bits.free[y]);
    rows.put([high](int8x16_t its) { return vcltq_s8(its, high); }, &bits.from_below[y]);
  }
  return bits;
}

}  // namespace iog::placing
