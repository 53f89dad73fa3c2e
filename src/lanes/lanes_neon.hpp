// Operations on sixteen indexes or two rows of bits at a time, implemented with NEON for the
// target.
#pragma once

#include <arm_neon.h>
#include <array>
#include <cstdint>

#include "lanes/lane_bytes.hpp"

namespace iog::lanes {

class NeonLanes {
 public:
  // A `memcpy` with a known alignment saves one cycle.
  static NeonLanes load(const LaneBytes& from) {
    int8x16_t lanes;
    __builtin_memcpy(&lanes, __builtin_assume_aligned(&from, kLaneCount), kLaneCount);
    return NeonLanes(lanes);
  }
  static NeonLanes load_bytes(const std::int8_t* from) { return NeonLanes(vld1q_s8(from)); }
  static NeonLanes all(std::int8_t value) { return NeonLanes(vdupq_n_s8(value)); }
  void store(LaneBytes& to) const {
    __builtin_memcpy(__builtin_assume_aligned(&to, kLaneCount), &lanes_, kLaneCount);
  }
  void store_bytes(std::int8_t* to) const { vst1q_s8(to, lanes_); }

  [[nodiscard]] int8x16_t native() const { return lanes_; }

  [[nodiscard]] NeonLanes bit_and(NeonLanes mask) const {
    return NeonLanes(vandq_s8(lanes_, mask.lanes_));
  }
  [[nodiscard]] NeonLanes and_not(NeonLanes mask) const {
    return NeonLanes(vbicq_s8(lanes_, mask.lanes_));
  }
  [[nodiscard]] NeonLanes subtract(NeonLanes amount) const {
    return NeonLanes(vqsubq_s8(lanes_, amount.lanes_));
  }
  [[nodiscard]] NeonLanes add(NeonLanes other) const {
    return NeonLanes(vqaddq_s8(lanes_, other.lanes_));
  }
  [[nodiscard]] NeonLanes above_zero() const {
    return NeonLanes(vreinterpretq_s8_u8(vcgtq_s8(lanes_, vdupq_n_s8(0))));
  }
  [[nodiscard]] NeonLanes max(NeonLanes least) const {
    return NeonLanes(vmaxq_s8(lanes_, least.lanes_));
  }
  [[nodiscard]] NeonLanes bit_or(NeonLanes other) const {
    return NeonLanes(vorrq_s8(lanes_, other.lanes_));
  }
  [[nodiscard]] bool is_zero() const {
    const int8x8_t halves = vorr_s8(vget_low_s8(lanes_), vget_high_s8(lanes_));
    return vget_lane_u64(vreinterpret_u64_s8(halves), 0) == 0;
  }
  // First, the sign of each lane is copied to all its bits, and a mask keeps only the lane's own
  // bit. Then, sums of neighbouring lanes gather the bits.
  static std::array<std::uint32_t, 4> negative(const std::array<NeonLanes, 4>& left,
                                               const std::array<NeonLanes, 4>& right) {
    const uint8x8_t own = vcreate_u8(0x8040201008040201U);
    const auto sums = [own](int8x16_t lanes) {
      const uint8x16_t signs =
          vandq_u8(vreinterpretq_u8_s8(vshrq_n_s8(lanes, 7)), vcombine_u8(own, own));
      return vpadd_u8(vget_low_u8(signs), vget_high_u8(signs));
    };
    const auto row = [&](std::size_t y) {
      return vpadd_u8(sums(left[y].lanes_), sums(right[y].lanes_));
    };
    std::array<std::uint32_t, 4> rows;
    vst1_u32(&rows[0], vreinterpret_u32_u8(vpadd_u8(row(0), row(1))));
    vst1_u32(&rows[2], vreinterpret_u32_u8(vpadd_u8(row(2), row(3))));
    return rows;
  }

  static std::array<NeonLanes, 4> rows_of(const LaneBytes* four) {
    const int32x4x4_t rows = vld4q_s32(reinterpret_cast<const std::int32_t*>(four));
    return {
        NeonLanes(vreinterpretq_s8_s32(rows.val[0])), NeonLanes(vreinterpretq_s8_s32(rows.val[1])),
        NeonLanes(vreinterpretq_s8_s32(rows.val[2])), NeonLanes(vreinterpretq_s8_s32(rows.val[3]))};
  }

 private:
  explicit NeonLanes(int8x16_t lanes) : lanes_(lanes) {}
  int8x16_t lanes_;
};

class NeonRowPair {
 public:
  static NeonRowPair load(const std::uint64_t* from) { return NeonRowPair(vld1q_u64(from)); }
  void store(std::uint64_t* to) const { vst1q_u64(to, rows_); }
  void store_middle(std::uint32_t* to) const { vst1_u32(to, vshrn_n_u64(rows_, 16)); }

  [[nodiscard]] NeonRowPair bit_and(NeonRowPair other) const {
    return NeonRowPair(vandq_u64(rows_, other.rows_));
  }
  [[nodiscard]] NeonRowPair bit_or(NeonRowPair other) const {
    return NeonRowPair(vorrq_u64(rows_, other.rows_));
  }
  [[nodiscard]] NeonRowPair and_not(NeonRowPair other) const {
    return NeonRowPair(vbicq_u64(rows_, other.rows_));
  }

  template <int kBits>
  [[nodiscard]] NeonRowPair up() const {
    return NeonRowPair(vshlq_n_u64(rows_, kBits));
  }
  template <int kBits>
  [[nodiscard]] NeonRowPair down() const {
    return NeonRowPair(vshrq_n_u64(rows_, kBits));
  }

 private:
  explicit NeonRowPair(uint64x2_t rows) : rows_(rows) {}

  uint64x2_t rows_;
};

}  // namespace iog::lanes
