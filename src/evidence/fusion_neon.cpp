// NEON version for eight cells at once. VQDMULH.S16 is floor(2ab / 2^16), which is a.b of
// evidence/cell.hpp. VQRDMULH.S16 is the same rounded to nearest, a half up. Both saturate only at
// (-2^15)^2, which never occurs: the other factor of kWhole is a mass. evidence/cell.hpp proves all
// ranges.
#include <arm_neon.h>
#include <cstddef>

#include "evidence/free_lanes_neon.hpp"
#include "evidence/fusion.hpp"
#include "evidence/mass_lanes_neon.hpp"

namespace iog::evidence {
namespace {

static_assert(offsetof(Gains, persistence) == 2 && offsetof(Gains, specialisation) == 6);

// Lane 1: persistence, 2: decline, 3: specialisation.
int16x4_t weights_of(const Gains& gains) {
  int16x4_t weights;
  __builtin_memcpy(&weights, &gains, sizeof(weights));
  return weights;
}

// The masses of a table by index, in units of 2^-15. Indexes below 0 give 0, because a lookup
// outside the table gives 0.
int16x8_t graded(const MassTable& table, int8x8_t indexes) {
  uint8x8x4_t rows;
  __builtin_memcpy(&rows, __builtin_assume_aligned(table.data(), sizeof(rows)), sizeof(rows));
  const int8x8_t last = vdup_n_s8(kGradedIndexes - 1);
  const uint8x8_t masses = vtbl4_u8(rows, vreinterpret_u8_s8(vmin_s8(indexes, last)));
  return vreinterpretq_s16_u16(vshll_n_u8(masses, 8));
}

// All ones in the lanes whose bit is set.
int16x8_t lanes_of(std::uint8_t bits) {
  constexpr std::uint64_t kOneOfEach = 0x8040'2010'0804'0201;
  const uint8x8_t set = vtst_u8(vdup_n_u8(bits), vcreate_u8(kOneOfEach));
  return vmovl_s8(vreinterpret_s8_u8(set));
}

int16x8_t persistence_of(int16x8_t before, int16x8_t taken, int16x8_t conflict, int16x4_t gains) {
  const int16x8_t gain = vqrdmulhq_lane_s16(product(taken, complement(conflict)), gains, 1);
  const int16x8_t loss = vqrdmulhq_lane_s16(complement(taken), gains, 2);
  return vmaxq_s16(vqaddq_s16(before, vsubq_s16(gain, loss)), vdupq_n_s16(0));
}

// The five values of eight cells.
struct Lanes {
  int16x8_t free;
  int16x8_t occupied;
  int16x8_t moving;
  int16x8_t standing;
  int16x8_t persistence;
};

Lanes aged(const Free& free_before, const Taken& taken, const Fading& fading) {
  const int16x8_t factors = factors_of(fading);
  MassReader before(taken);
  const int16x8_t free = left_of<0>(load(free_before), vget_low_s16(factors));
  const int16x8_t occupied = left_of<1>(before.next(), vget_low_s16(factors));
  const int16x8_t moving = left_of<2>(before.next(), vget_low_s16(factors));
  const int16x8_t standing = left_of<3>(before.next(), vget_low_s16(factors));
  const int16x8_t persistence = left_of<0>(before.next(), vget_high_s16(factors));
  return {free, occupied, moving, standing, persistence};
}

// hit, crossed: o and f of evidence/cell.hpp.
inline void fuse_lanes(Free& free_masses, Taken& taken_masses, const Fading& fading,
                       int16x8_t indexes, int16x8_t hit, int16x8_t crossed, std::uint8_t moved,
                       int16x4_t gains) {
  const uint16x8_t no_evidence = vceqq_s16(indexes, vdupq_n_s16(0));
  const auto [free, occupied, moving, standing, old_persistence] =
      aged(free_masses, taken_masses, fading);
  const int16x8_t taken = vaddq_s16(vaddq_s16(occupied, moving), standing);
  const int16x8_t ignorance = vsubq_s16(complement(free), taken);
  const int16x8_t appeared = product(free, hit);
  const int16x8_t conflict = vaddq_s16(appeared, product(taken, crossed));
  const int16x8_t new_free = vaddq_s16(product(free, complement(hit)), product(ignorance, crossed));

  const int16x8_t not_free = complement(crossed);
  const int16x8_t came = vandq_s16(appeared, lanes_of(moved));
  const int16x8_t new_moving = vaddq_s16(product(moving, not_free), came);
  const int16x8_t new_standing = product(standing, not_free);
  const int16x8_t new_occupied = vaddq_s16(
      vaddq_s16(product(occupied, not_free), product(ignorance, hit)), vsubq_s16(appeared, came));

  const int16x8_t new_taken = vaddq_s16(vaddq_s16(new_occupied, new_moving), new_standing);
  const int16x8_t persistence = persistence_of(old_persistence, new_taken, conflict, gains);
  const int16x8_t part = vqdmulhq_lane_s16(persistence, gains, 3);
  const int16x8_t settled = product(new_occupied, part);

  store(choose(no_evidence, free, new_free), free_masses);
  MassWriter after(taken_masses);
  after.put(choose(no_evidence, occupied, vsubq_s16(new_occupied, settled)));
  after.put(choose(no_evidence, moving, product(new_moving, complement(part))));
  after.put(choose(no_evidence, standing, vaddq_s16(new_standing, settled)));
  after.put(choose(no_evidence, old_persistence, persistence));
}

}  // namespace

void age(Free& free_masses, Taken& taken, const Fading& fading) {
  const auto [free, occupied, moving, standing, persistence] = aged(free_masses, taken, fading);
  store(free, free_masses);
  MassWriter after(taken);
  after.put(occupied);
  after.put(moving);
  after.put(standing);
  after.put(persistence);
}

void fuse(Free& free, Taken& taken, const Fading& fading, const Indexes& indexes,
          std::uint8_t moved, const Gains& gains) {
  const int16x8_t wide = vmovl_s8(vld1_s8(indexes.data()));
  const int16x8_t free_mass = vld1q_dup_s16(&gains.free_mass);
  const int16x4_t weights = weights_of(gains);
  const int16x8_t hit_mass = vld1q_dup_s16(&gains.hit_mass);
  const uint16x8_t is_hit = vcgtq_s16(wide, vdupq_n_s16(0));
  fuse_lanes(free, taken, fading, wide, vandq_s16(hit_mass, vreinterpretq_s16_u16(is_hit)),
             vandq_s16(free_mass, is_crossed(wide)), moved, weights);
}

void fuse(Free& free, Taken& taken, const Fading& fading, const Indexes& indexes,
          std::uint8_t moved, const Gains& gains, const Assignment& assignment) {
  const int8x8_t narrow = vld1_s8(indexes.data());
  const int16x8_t wide = vmovl_s8(narrow);
  const auto by_time = static_cast<std::int16_t>(gains.free_mass & assignment.free_by_time);
  const int16x8_t crossed = vorrq_s16(graded(assignment.free, vqneg_s8(narrow)),
                                      vandq_s16(vdupq_n_s16(by_time), is_crossed(wide)));
  fuse_lanes(free, taken, fading, wide, graded(assignment.occupied, narrow), crossed, moved,
             weights_of(gains));
}

void age_free(Free& free, const Fading& fading) {
  store(left_of<0>(load(free), vget_low_s16(factors_of(fading))), free);
}

void fuse_free(Free& free, const Fading& fading, const Indexes& indexes, const Gains& gains) {
  store(free_after(load(free), vld1q_dup_s16(&fading.free), vld1_s8(indexes.data()),
                   vld1q_dup_s16(&gains.free_mass)),
        free);
}

}  // namespace iog::evidence
