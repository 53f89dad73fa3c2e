// Ages a group's free masses and fuses a frame's evidence into them. Each register holds eight
// cells. These functions are the building blocks of fusion_neon.cpp.
#pragma once

#include <arm_neon.h>
#include <cstddef>

#include "evidence/assignment.hpp"
#include "evidence/factors.hpp"
#include "evidence/group.hpp"

namespace iog::evidence {

inline int16x8_t product(int16x8_t a, int16x8_t b) { return vqdmulhq_s16(a, b); }

// An XOR with 32767 computes `32767 - a` because the lower 15 bits of 32767 are all set.
inline int16x8_t complement(int16x8_t a) { return veorq_s16(a, vdupq_n_s16(kCertain)); }

inline int16x8_t choose(uint16x8_t mask, int16x8_t yes, int16x8_t no) {
  return vbslq_s16(mask, yes, no);
}

static_assert(sizeof(Fading) == sizeof(int16x8_t) && offsetof(Fading, persistence) == 8);

// Lanes 0 to 3 contain the factors for free, occupied, moving and standing. Lane 4 contains the
// factor for persistence.
inline int16x8_t factors_of(const Fading& fading) {
  int16x8_t factors;
  __builtin_memcpy(&factors, &fading, sizeof(factors));
  return factors;
}

// kWhole represents -1, so the product of a mass and kWhole is exactly -mass. The product with any
// other factor is not negative.
template <int kLane>
inline int16x8_t left_of(int16x8_t mass, int16x4_t factors) {
  return vabsq_s16(vqdmulhq_lane_s16(mass, factors, kLane));
}

// Sets all bits in the lanes of crossed cells.
inline int16x8_t is_crossed(int16x8_t indexes) { return vshrq_n_s16(indexes, 15); }

// Returns the free mass after a frame without hits, for a group without occupied mass. In this
// case, o, c, x and P are 0, so `F' = F.~0 + W.f` with `W = ~F`.
inline int16x8_t free_after(int16x8_t free, int16x8_t factor, int8x8_t indexes,
                            int16x8_t free_mass) {
  const int16x8_t before = vabsq_s16(product(free, factor));
  const int16x8_t after =
      vaddq_s16(product(before, vdupq_n_s16(kCertain)), product(complement(before), free_mass));
  return choose(vreinterpretq_u16_s16(is_crossed(vmovl_s8(indexes))), after, before);
}

}  // namespace iog::evidence
