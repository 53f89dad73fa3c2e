// Sixteen occupancy indexes at once: what the machine adds with saturation in one instruction.
//
// The same on every machine, bit for bit: NEON on the target, SSE2 on a PC, and plain C++
// elsewhere, which is the specification (tests/host/grid/lanes_test.cpp compares).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#if defined(__ARM_NEON)
#include <arm_neon.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "index/occupancy_index.hpp"

namespace iog::grid {

inline constexpr std::size_t kLaneCount = 16;

// Sixteen bytes as they lie in memory.
struct alignas(kLaneCount) LaneBytes {
  std::array<std::int8_t, kLaneCount> bytes{};
  friend constexpr bool operator==(const LaneBytes&, const LaneBytes&) = default;
};

// What subtract() of any Lanes computes, lane by lane: the difference, but not below -128.
[[nodiscard]] constexpr std::int8_t subtract_saturated(std::int8_t minuend, std::int8_t amount) {
  const int difference = minuend - amount;
  return static_cast<std::int8_t>(difference < -128 ? -128 : difference > 127 ? 127 : difference);
}

// The plain ones.
class PlainLanes {
 public:
  static PlainLanes load(const LaneBytes& from) { return PlainLanes(from); }
  static PlainLanes all(std::int8_t value) {
    LaneBytes lanes;
    lanes.bytes.fill(value);
    return PlainLanes(lanes);
  }
  void store(LaneBytes& to) const { to = lanes_; }
  void store_bytes(std::int8_t* to) const {
    std::copy(lanes_.bytes.begin(), lanes_.bytes.end(), to);
  }

  [[nodiscard]] PlainLanes masked(PlainLanes mask) const {
    return each(mask, [](std::int8_t a, std::int8_t b) { return static_cast<std::int8_t>(a & b); });
  }
  [[nodiscard]] PlainLanes without(PlainLanes mask) const {
    return each(mask,
                [](std::int8_t a, std::int8_t b) { return static_cast<std::int8_t>(a & ~b); });
  }
  [[nodiscard]] PlainLanes subtract(PlainLanes amount) const {
    return each(amount, subtract_saturated);
  }
  [[nodiscard]] PlainLanes raised_to(PlainLanes least) const {
    return each(least, [](std::int8_t a, std::int8_t b) { return a < b ? b : a; });
  }
  [[nodiscard]] PlainLanes united(PlainLanes other) const {
    return each(other,
                [](std::int8_t a, std::int8_t b) { return static_cast<std::int8_t>(a | b); });
  }
  [[nodiscard]] bool is_zero() const { return lanes_ == LaneBytes{}; }

  // Quarter i of each of four, for i = 0 ... 3: the rows of four blocks beside one another.
  static std::array<PlainLanes, 4> rows_of(const LaneBytes* four) {
    std::array<LaneBytes, 4> rows;
    for (std::size_t i = 0; i < 4 * kLaneCount; ++i) {
      rows[i / 4 % 4].bytes[i / kLaneCount * 4 + i % 4] =
          four[i / kLaneCount].bytes[i % kLaneCount];
    }
    return {PlainLanes(rows[0]), PlainLanes(rows[1]), PlainLanes(rows[2]), PlainLanes(rows[3])};
  }

 private:
  explicit PlainLanes(const LaneBytes& lanes) : lanes_(lanes) {}

  template <typename Operation>
  [[nodiscard]] PlainLanes each(PlainLanes other, Operation&& operation) const {
    LaneBytes result;
    for (std::size_t i = 0; i < kLaneCount; ++i) {
      result.bytes[i] = operation(lanes_.bytes[i], other.lanes_.bytes[i]);
    }
    return PlainLanes(result);
  }

  LaneBytes lanes_;
};

#if defined(__ARM_NEON)

class Lanes {
 public:
  // By way of memcpy the compiler knows of the alignment, which spares the core a cycle.
  static Lanes load(const LaneBytes& from) {
    int8x16_t lanes;
    __builtin_memcpy(&lanes, __builtin_assume_aligned(&from, kLaneCount), kLaneCount);
    return Lanes(lanes);
  }
  static Lanes all(std::int8_t value) { return Lanes(vdupq_n_s8(value)); }
  void store(LaneBytes& to) const {
    __builtin_memcpy(__builtin_assume_aligned(&to, kLaneCount), &lanes_, kLaneCount);
  }
  void store_bytes(std::int8_t* to) const { vst1q_s8(to, lanes_); }

  [[nodiscard]] int8x16_t native() const { return lanes_; }

  [[nodiscard]] Lanes masked(Lanes mask) const { return Lanes(vandq_s8(lanes_, mask.lanes_)); }
  [[nodiscard]] Lanes without(Lanes mask) const { return Lanes(vbicq_s8(lanes_, mask.lanes_)); }
  [[nodiscard]] Lanes subtract(Lanes amount) const {
    return Lanes(vqsubq_s8(lanes_, amount.lanes_));
  }
  [[nodiscard]] Lanes raised_to(Lanes least) const { return Lanes(vmaxq_s8(lanes_, least.lanes_)); }
  [[nodiscard]] Lanes united(Lanes other) const { return Lanes(vorrq_s8(lanes_, other.lanes_)); }
  [[nodiscard]] bool is_zero() const {
    const int8x8_t halves = vorr_s8(vget_low_s8(lanes_), vget_high_s8(lanes_));
    return vget_lane_u64(vreinterpret_u64_s8(halves), 0) == 0;
  }

  static std::array<Lanes, 4> rows_of(const LaneBytes* four) {
    const int32x4x4_t rows = vld4q_s32(reinterpret_cast<const std::int32_t*>(four));
    return {Lanes(vreinterpretq_s8_s32(rows.val[0])), Lanes(vreinterpretq_s8_s32(rows.val[1])),
            Lanes(vreinterpretq_s8_s32(rows.val[2])), Lanes(vreinterpretq_s8_s32(rows.val[3]))};
  }

 private:
  explicit Lanes(int8x16_t lanes) : lanes_(lanes) {}
  int8x16_t lanes_;
};

#elif defined(__SSE2__)

class Lanes {
 public:
  static Lanes load(const LaneBytes& from) {
    return Lanes(_mm_load_si128(reinterpret_cast<const __m128i*>(&from)));
  }
  static Lanes all(std::int8_t value) { return Lanes(_mm_set1_epi8(value)); }
  void store(LaneBytes& to) const { _mm_store_si128(reinterpret_cast<__m128i*>(&to), lanes_); }
  void store_bytes(std::int8_t* to) const {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), lanes_);
  }

  [[nodiscard]] Lanes masked(Lanes mask) const { return Lanes(_mm_and_si128(lanes_, mask.lanes_)); }
  [[nodiscard]] Lanes without(Lanes mask) const {
    return Lanes(_mm_andnot_si128(mask.lanes_, lanes_));
  }
  [[nodiscard]] Lanes subtract(Lanes amount) const {
    return Lanes(_mm_subs_epi8(lanes_, amount.lanes_));
  }
  // SSE2 has no maximum of signed bytes: select by comparing.
  [[nodiscard]] Lanes raised_to(Lanes least) const {
    const __m128i below = _mm_cmplt_epi8(lanes_, least.lanes_);
    return Lanes(_mm_or_si128(_mm_and_si128(below, least.lanes_), _mm_andnot_si128(below, lanes_)));
  }
  [[nodiscard]] Lanes united(Lanes other) const {
    return Lanes(_mm_or_si128(lanes_, other.lanes_));
  }
  [[nodiscard]] bool is_zero() const {
    return _mm_movemask_epi8(_mm_cmpeq_epi8(lanes_, _mm_setzero_si128())) == 0xFFFF;
  }

  static std::array<Lanes, 4> rows_of(const LaneBytes* four) {
    const __m128i a = load(four[0]).lanes_;
    const __m128i b = load(four[1]).lanes_;
    const __m128i c = load(four[2]).lanes_;
    const __m128i d = load(four[3]).lanes_;
    const __m128i ab_low = _mm_unpacklo_epi32(a, b);
    const __m128i ab_high = _mm_unpackhi_epi32(a, b);
    const __m128i cd_low = _mm_unpacklo_epi32(c, d);
    const __m128i cd_high = _mm_unpackhi_epi32(c, d);
    return {Lanes(_mm_unpacklo_epi64(ab_low, cd_low)), Lanes(_mm_unpackhi_epi64(ab_low, cd_low)),
            Lanes(_mm_unpacklo_epi64(ab_high, cd_high)),
            Lanes(_mm_unpackhi_epi64(ab_high, cd_high))};
  }

 private:
  explicit Lanes(__m128i lanes) : lanes_(lanes) {}
  __m128i lanes_;
};

#else

using Lanes = PlainLanes;

#endif

}  // namespace iog::grid
