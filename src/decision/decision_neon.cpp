// Eight cells at once. What is compared with 2^14 is compared by its upper byte, which is at least
// 64 in the same cases; an upper byte of 64 + 8 n + r is level n.
//
// At most one of free, moving and standing is half of all or more (decision/cell.hpp). So the
// greatest of them is the score if it is; else the score is what is taken.
#include <arm_neon.h>

#include "decision/cell.hpp"
#include "decision/decision.hpp"

namespace iog::decision {
namespace {

constexpr std::size_t kMassesAlignment = 16;

int16x8_t load(const evidence::Masses& masses) {
  int16x8_t lanes;
  __builtin_memcpy(&lanes, __builtin_assume_aligned(masses.data(), kMassesAlignment),
                   sizeof(lanes));
  return lanes;
}

uint8x8_t upper_byte(int16x8_t mass) { return vshrn_n_u16(vreinterpretq_u16_s16(mass), 8); }

uint8x8_t is_half(uint8x8_t upper) { return vcge_u8(upper, vdup_n_u8(kHalf >> 8)); }

// What a class adds to its upper byte shifted by 3, which is 8 plus the level.
constexpr std::uint8_t base_of(std::uint8_t name) {
  return static_cast<std::uint8_t>(name * 8 - 8);
}
constexpr std::uint8_t base_of(Class name) { return base_of(static_cast<std::uint8_t>(name)); }

constexpr std::uint64_t base_by_mask(const ByMask& classes) {
  std::uint64_t bases = 0;
  for (std::size_t mask = 0; mask < classes.size(); ++mask) {
    bases |= std::uint64_t{base_of(classes[mask])} << (8 * mask);
  }
  return bases;
}

constexpr std::uint64_t shares_by_mask() {
  std::uint64_t shares = 0;
  for (std::size_t mask = 0; mask < kMovingShares.size(); ++mask) {
    shares |= std::uint64_t{kMovingShares[mask]} << (8 * mask);
  }
  return shares;
}

// The part of O that counts as moving.
int16x8_t moving_part(int16x8_t occupied, uint8x8_t masks) {
  const uint8x8_t shares = vtbl1_u8(vcreate_u8(shares_by_mask()), masks);
  return vqdmulhq_s16(occupied, vreinterpretq_s16_u16(vshll_n_u8(shares, 7)));
}

// Bytes of all ones where a mass is above a level.
uint8x8_t is_above(int16x8_t mass, std::int16_t level) {
  return vmovn_u16(vcgtq_s16(mass, vdupq_n_s16(level)));
}

// The lowest bits of four groups of eight bytes, all ones or zeros each.
Bits bits_of(uint8x8_t freed, uint8x8_t seen, uint8x8_t stands, uint8x8_t taken) {
  const uint8x8_t one_of_each = vcreate_u8(0x8040'2010'0804'0201);
  const auto kept = [one_of_each](uint8x8_t a, uint8x8_t b) {
    return vpadd_u8(vand_u8(a, one_of_each), vand_u8(b, one_of_each));
  };
  const uint8x8_t pairs = vpadd_u8(kept(freed, seen), kept(stands, taken));
  const std::uint32_t word = vget_lane_u32(vreinterpret_u32_u8(vpadd_u8(pairs, pairs)), 0);
  return __builtin_bit_cast(Bits, word);
}

}  // namespace

Bits decide(evidence::Group& group, const evidence::Indexes& of_this_frame) {
  const int16x8_t free = load(group.free);
  const int16x8_t occupied = load(group.occupied);
  const int16x8_t taken = vaddq_s16(vaddq_s16(occupied, load(group.moving)), load(group.standing));
  const uint8x8_t masks = vbic_u8(vdup_n_u8(kAnywhere), vld1_u8(group.ruled_out.data()));
  const int16x8_t moving = vaddq_s16(load(group.moving), moving_part(occupied, masks));

  const uint8x8_t of_free = upper_byte(free);
  const uint8x8_t of_moving = upper_byte(moving);
  const uint8x8_t of_standing = upper_byte(vsubq_s16(taken, moving));
  const uint8x8_t most = vmax_u8(of_free, vmax_u8(of_moving, of_standing));
  const uint8x8_t score = vbsl_u8(is_half(most), most, upper_byte(taken));

  const uint8x8_t free_base = vtbl1_u8(vcreate_u8(base_by_mask(kFreeClasses)), masks);
  const uint8x8_t standing_base = vtbl1_u8(vcreate_u8(base_by_mask(kStandingClasses)), masks);
  uint8x8_t base =
      vbsl_u8(is_half(of_standing), standing_base, vdup_n_u8(base_of(Class::kOccupied)));
  base = vbsl_u8(is_half(of_moving), vdup_n_u8(base_of(Class::kMoving)), base);
  base = vbsl_u8(is_half(of_free), free_base, base);
  const uint8x8_t bytes = vand_u8(vsra_n_u8(base, score, 3), is_half(score));
  vst1_s8(group.decided.data(), vreinterpret_s8_u8(bytes));

  const int8x8_t indexes = vld1_s8(of_this_frame.data());
  const uint8x8_t crossed = vclt_s8(indexes, vdup_n_s8(0));
  return bits_of(is_above(free, kFreedAbove), vand_u8(is_above(free, kSeenAbove), crossed),
                 is_above(load(group.persistence), kStandsAbove), is_above(taken, kTakenAbove));
}

}  // namespace iog::decision
