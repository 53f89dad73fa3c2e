// Eight cells at once. VQDMULH.S16 is floor(2ab / 2^16), which is the a.b of evidence/cell.hpp;
// VQRDMULH.S16 is the same rounded to nearest, a half up. Both saturate only at (-2^15)^2, which
// never occurs: the other factor of kWhole is a mass. All ranges are proven in evidence/cell.hpp.
#include <arm_neon.h>

#include "evidence/fusion.hpp"

namespace iog::evidence {
namespace {

constexpr std::size_t kMassesAlignment = 16;

int16x8_t load(const Masses& masses) {
  int16x8_t lanes;
  __builtin_memcpy(&lanes, __builtin_assume_aligned(masses.data(), kMassesAlignment),
                   sizeof(lanes));
  return lanes;
}

void store(int16x8_t lanes, Masses& masses) {
  __builtin_memcpy(__builtin_assume_aligned(masses.data(), kMassesAlignment), &lanes,
                   sizeof(lanes));
}

int16x8_t product(int16x8_t a, int16x8_t b) { return vqdmulhq_s16(a, b); }

// 0 ... 32767 has no bit that 32767 lacks.
int16x8_t complement(int16x8_t a) { return veorq_s16(a, vdupq_n_s16(kCertain)); }

int16x8_t choose(uint16x8_t mask, int16x8_t yes, int16x8_t no) { return vbslq_s16(mask, yes, no); }

// A product with kWhole is -mass, exactly; one with any other factor is not negative.
template <int kLane>
int16x8_t left_of(const Masses& masses, int16x4_t factors) {
  return vabsq_s16(vqdmulhq_lane_s16(load(masses), factors, kLane));
}

// The masses of a table by index, in units of 2^-15; 0 of an index below 0, because a lookup out of
// the table gives 0.
int16x8_t graded(const std::array<std::uint8_t, kGradedIndexes>& table, int8x8_t indexes) {
  uint8x8x4_t rows;
  __builtin_memcpy(&rows, __builtin_assume_aligned(table.data(), kMassesAlignment), sizeof(rows));
  const int8x8_t last = vdup_n_s8(kGradedIndexes - 1);
  const uint8x8_t masses = vtbl4_u8(rows, vreinterpret_u8_s8(vmin_s8(indexes, last)));
  return vreinterpretq_s16_u16(vshll_n_u8(masses, 8));
}

// All ones in the lanes whose bit is set.
uint16x8_t lanes_of(std::uint8_t bits) {
  constexpr std::uint64_t kOneOfEach = 0x8040'2010'0804'0201;
  const uint8x8_t set = vtst_u8(vdup_n_u8(bits), vcreate_u8(kOneOfEach));
  return vreinterpretq_u16_s16(vmovl_s8(vreinterpret_s8_u8(set)));
}

struct Lanes {
  int16x8_t free;
  int16x8_t occupied;
  int16x8_t moving;
  int16x8_t standing;

  [[nodiscard]] int16x8_t taken() const { return vaddq_s16(vaddq_s16(occupied, moving), standing); }
};

Lanes combined(const Lanes& cells, int16x8_t hit, int16x8_t crossed, int16x8_t ignorance,
               int16x8_t appeared, uint16x8_t moved) {
  const int16x8_t not_free = complement(crossed);
  const int16x8_t came = vandq_s16(appeared, vreinterpretq_s16_u16(moved));
  const int16x8_t stays = vsubq_s16(appeared, came);
  return {
      .free = vaddq_s16(product(cells.free, complement(hit)), product(ignorance, crossed)),
      .occupied =
          vaddq_s16(vaddq_s16(product(cells.occupied, not_free), product(ignorance, hit)), stays),
      .moving = vaddq_s16(product(cells.moving, not_free), came),
      .standing = product(cells.standing, not_free),
  };
}

int16x8_t persistence_of(int16x8_t before, int16x8_t taken, int16x8_t conflict, int16x4_t gains) {
  const int16x8_t gain = vqrdmulhq_lane_s16(product(taken, complement(conflict)), gains, 1);
  const int16x8_t loss = vqrdmulhq_lane_s16(complement(taken), gains, 2);
  return vmaxq_s16(vqaddq_s16(before, vsubq_s16(gain, loss)), vdupq_n_s16(0));
}

}  // namespace

void age(Group& group, const Fading& fading) {
  const int16x4_t factors = vld1_s16(&fading.free);
  const int16x4_t of_persistence = vld1_dup_s16(&fading.persistence);
  store(left_of<0>(group.free, factors), group.free);
  store(left_of<1>(group.occupied, factors), group.occupied);
  store(left_of<2>(group.moving, factors), group.moving);
  store(left_of<3>(group.standing, factors), group.standing);
  store(left_of<0>(group.persistence, of_persistence), group.persistence);
}

void fuse(Group& group, const Indexes& indexes, std::uint8_t moved, const Gains& gains,
          const Assignment& assignment) {
  const int8x8_t narrow = vld1_s8(indexes.data());
  const int16x8_t wide = vmovl_s8(narrow);
  const uint16x8_t has_evidence = vtstq_s16(wide, wide);
  const int16x4_t weights = vld1_s16(&gains.free_mass);

  const int16x8_t hit = graded(assignment.occupied, narrow);
  const std::int16_t by_time = static_cast<std::int16_t>(gains.free_mass & assignment.free_by_time);
  const int16x8_t crossed = vorrq_s16(graded(assignment.free, vqneg_s8(narrow)),
                                      vandq_s16(vshrq_n_s16(wide, 15), vdupq_n_s16(by_time)));

  const Lanes before{load(group.free), load(group.occupied), load(group.moving),
                     load(group.standing)};
  const int16x8_t taken = before.taken();
  const int16x8_t ignorance = vsubq_s16(complement(before.free), taken);
  const int16x8_t appeared = product(before.free, hit);
  const Lanes next = combined(before, hit, crossed, ignorance, appeared, lanes_of(moved));
  const int16x8_t persistence = persistence_of(
      load(group.persistence), next.taken(), vaddq_s16(appeared, product(taken, crossed)), weights);

  const int16x8_t part = vqdmulhq_lane_s16(persistence, weights, 3);
  const int16x8_t settled = product(next.occupied, part);
  store(choose(has_evidence, next.free, before.free), group.free);
  store(choose(has_evidence, vsubq_s16(next.occupied, settled), before.occupied), group.occupied);
  store(choose(has_evidence, product(next.moving, complement(part)), before.moving), group.moving);
  store(choose(has_evidence, vaddq_s16(next.standing, settled), before.standing), group.standing);
  store(choose(has_evidence, persistence, load(group.persistence)), group.persistence);
}

}  // namespace iog::evidence
