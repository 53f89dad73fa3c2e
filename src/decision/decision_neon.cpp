// NEON version for eight cells at once. Comparisons with 2^14 use the upper byte of a mass, which
// is at least 64 in the same cases. An upper byte of 64 + 8 n + r is confidence n.
//
// At most one of free, moving and standing reaches half of all mass (decision/cell.hpp). If one
// does, it is the greatest of the three and the score. Otherwise the score is the occupied mass.
#include <arm_neon.h>
#include <cstddef>

#include "decision/cell.hpp"
#include "decision/decision.hpp"
#include "evidence/free_lanes_neon.hpp"
#include "evidence/mass_lanes_neon.hpp"

namespace iog::decision {
namespace {

uint8x8_t upper_byte(int16x8_t mass) { return vshrn_n_u16(vreinterpretq_u16_s16(mass), 8); }

uint8x8_t is_half(uint8x8_t upper) { return vcge_u8(upper, vdup_n_u8(kHalf >> 8)); }

// The value that a class adds to its upper byte shifted right by 3, which is 8 plus the confidence.
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

// Sets the sign bit of each byte whose mass is above the level, by taking the upper byte of level -
// mass.
uint8x8_t above(int16x8_t mass, std::int16_t level) {
  return vreinterpret_u8_s8(vsubhn_s16(vdupq_n_s16(level), mass));
}

constexpr std::uint64_t kOneOfEach = 0x8040'2010'0804'0201;

// Gathers the signs of two vectors of eight bytes. Each vector gives four bytes, whose sum has one
// bit per sign.
uint8x8_t signs_of(uint8x8_t a, uint8x8_t b) {
  const uint8x16_t one_of_each = vreinterpretq_u8_u64(vdupq_n_u64(kOneOfEach));
  const uint8x16_t is_set = vcltq_s8(vreinterpretq_s8_u8(vcombine_u8(a, b)), vdupq_n_s8(0));
  const uint8x16_t kept = vandq_u8(is_set, one_of_each);
  return vpadd_u8(vget_low_u8(kept), vget_high_u8(kept));
}

// held: all ones or zeros per cell. Its byte appears four times in the sum, once at its place in
// Bits.
Bits bits_of(uint8x8_t freed, uint8x8_t seen, uint8x8_t stands, uint8x8_t taken, uint8x8_t held) {
  const uint8x8_t pairs = vpadd_u8(signs_of(freed, seen), signs_of(stands, taken));
  const uint8x8_t kept = vand_u8(held, vcreate_u8(kOneOfEach));
  const uint8x8_t twos = vpadd_u8(kept, kept);
  const uint8x8_t bytes = vpadd_u8(pairs, vpadd_u8(twos, twos));
  return __builtin_bit_cast(Bits, bytes);
}
static_assert(offsetof(Bits, held) == 4);

// The class bytes of the cells.
uint8x8_t bytes_of(int16x8_t free, int16x8_t moving, int16x8_t taken, uint8x8_t masks) {
  const uint8x8_t of_free = upper_byte(free);
  const uint8x8_t of_moving = upper_byte(moving);
  const uint8x8_t of_standing = upper_byte(vsubq_s16(taken, moving));
  const uint8x8_t most = vmax_u8(of_free, vmax_u8(of_moving, of_standing));
  const uint8x8_t score = vbsl_u8(is_half(most), most, upper_byte(taken));

  const uint8x8_t free_base = vtbl1_u8(vcreate_u8(base_by_mask(kFreeClasses)), masks);
  const uint8x8_t standing_base = vtbl1_u8(vcreate_u8(base_by_mask(kStandingClasses)), masks);
  uint8x8_t base = vdup_n_u8(base_of(Class::kOccupied));
  base = vbsl_u8(is_half(of_standing), standing_base, base);
  base = vbsl_u8(is_half(of_moving), vdup_n_u8(base_of(Class::kMoving)), base);
  base = vbsl_u8(is_half(of_free), free_base, base);
  return vand_u8(vsra_n_u8(base, score, 3), is_half(score));
}

uint8x8_t masks_of(const RuledOut& ruled_out) {
  uint8x8_t impossible;
  __builtin_memcpy(&impossible, __builtin_assume_aligned(ruled_out.data(), 8), 8);
  return vbic_u8(vdup_n_u8(kAnywhere), impossible);
}

void store(uint8x8_t bytes, Decided& decided) {
  __builtin_memcpy(__builtin_assume_aligned(decided.data(), 8), &bytes, 8);
}

// Sign bits of cells that are free and were crossed in this frame.
uint8x8_t seen_of(int16x8_t free, int8x8_t of_this_frame) {
  return vand_u8(above(free, kSeenAbove), vreinterpret_u8_s8(of_this_frame));
}

// The class bytes of a group without occupied mass.
inline uint8x8_t named_free(int16x8_t free, const RuledOut& ruled_out) {
  const uint8x8_t score = upper_byte(free);
  const uint8x8_t base = vtbl1_u8(vcreate_u8(base_by_mask(kFreeClasses)), masks_of(ruled_out));
  return vand_u8(vsra_n_u8(base, score, 3), is_half(score));
}

}  // namespace

Bits decide(const evidence::Free& free_masses, const evidence::Taken& taken_masses,
            const RuledOut& ruled_out, const evidence::Indexes& of_this_frame, Decided& decided) {
  const int16x8_t free = evidence::load(free_masses);
  evidence::MassReader masses(taken_masses);
  const int16x8_t occupied = masses.next();
  const int16x8_t only_moving = masses.next();
  const int16x8_t taken = vaddq_s16(vaddq_s16(occupied, only_moving), masses.next());
  const int16x8_t persistence = masses.next();
  const uint8x8_t masks = masks_of(ruled_out);
  const int16x8_t moving = vaddq_s16(only_moving, moving_part(occupied, masks));
  store(bytes_of(free, moving, taken, masks), decided);

  const int16x8_t any = vorrq_s16(taken, persistence);
  return bits_of(above(free, kFreedAbove), seen_of(free, vld1_s8(of_this_frame.data())),
                 above(persistence, kStandsAbove), above(taken, kTakenAbove),
                 vmovn_u16(vtstq_s16(any, any)));
}

FreeBits decide_free(const evidence::Free& free_masses, const RuledOut& ruled_out,
                     const evidence::Indexes& of_this_frame, Decided& decided) {
  const int16x8_t free = evidence::load(free_masses);
  store(named_free(free, ruled_out), decided);
  const uint8x8_t fours =
      signs_of(above(free, kFreedAbove), seen_of(free, vld1_s8(of_this_frame.data())));
  const uint8x8_t twos = vpadd_u8(fours, fours);
  const uint8x8_t bytes = vpadd_u8(twos, twos);
  const std::uint16_t word = vget_lane_u16(vreinterpret_u16_u8(bytes), 0);
  return __builtin_bit_cast(FreeBits, word);
}

template <std::size_t kGroups>
std::uint64_t cross_free(const Crossed& groups) {
  // Copies, because a store of class bytes might alias the pointers.
  const auto [masses, fading, indexes, gains, ruled_out, decided] = groups;
  const int16x8_t factor = vld1q_dup_s16(&fading->free);
  const int16x8_t free_mass = vld1q_dup_s16(&gains->free_mass);
  uint8x8_t freed = vdup_n_u8(0);
  uint8x8_t seen = vdup_n_u8(0);
  uint8x8_t freed_of_last = freed;
  uint8x8_t seen_of_last = seen;
#pragma GCC unroll 2
  for (std::size_t i = 0; i < kGroups; i += 2) {
    const int8x8_t of_one = vld1_s8(indexes[i].data());
    const int8x8_t of_other = vld1_s8(indexes[i + 1].data());
    const int16x8_t one =
        evidence::free_after(evidence::load(masses[i]), factor, of_one, free_mass);
    const int16x8_t other =
        evidence::free_after(evidence::load(masses[i + 1]), factor, of_other, free_mass);
    evidence::store(one, masses[i]);
    evidence::store(other, masses[i + 1]);
    store(named_free(one, ruled_out[i]), decided[i]);
    store(named_free(other, ruled_out[i + 1]), decided[i + 1]);
    (i == 0 ? freed : freed_of_last) = signs_of(above(one, kFreedAbove), above(other, kFreedAbove));
    (i == 0 ? seen : seen_of_last) = signs_of(seen_of(one, of_one), seen_of(other, of_other));
  }
  const uint8x8_t bytes = vpadd_u8(vpadd_u8(freed, freed_of_last), vpadd_u8(seen, seen_of_last));
  return vget_lane_u64(vreinterpret_u64_u8(bytes), 0);
}
template std::uint64_t cross_free<2>(const Crossed& groups);
template std::uint64_t cross_free<4>(const Crossed& groups);

}  // namespace iog::decision
