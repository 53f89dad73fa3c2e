// Operations on sixteen indexes at a time, implemented with SSE2.
#pragma once

#include <array>
#include <cstdint>
#include <emmintrin.h>

#include "lanes/lanes_plain.hpp"

namespace iog::lanes {

class Sse2Lanes {
 public:
  static Sse2Lanes load(const LaneBytes& from) {
    return Sse2Lanes(_mm_load_si128(reinterpret_cast<const __m128i*>(&from)));
  }
  static Sse2Lanes load_bytes(const std::int8_t* from) {
    return Sse2Lanes(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
  }
  static Sse2Lanes all(std::int8_t value) { return Sse2Lanes(_mm_set1_epi8(value)); }
  void store(LaneBytes& to) const { _mm_store_si128(reinterpret_cast<__m128i*>(&to), lanes_); }
  void store_bytes(std::int8_t* to) const {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), lanes_);
  }

  [[nodiscard]] Sse2Lanes bit_and(Sse2Lanes mask) const {
    return Sse2Lanes(_mm_and_si128(lanes_, mask.lanes_));
  }
  [[nodiscard]] Sse2Lanes and_not(Sse2Lanes mask) const {
    return Sse2Lanes(_mm_andnot_si128(mask.lanes_, lanes_));
  }
  [[nodiscard]] Sse2Lanes subtract(Sse2Lanes amount) const {
    return Sse2Lanes(_mm_subs_epi8(lanes_, amount.lanes_));
  }
  [[nodiscard]] Sse2Lanes add(Sse2Lanes other) const {
    return Sse2Lanes(_mm_adds_epi8(lanes_, other.lanes_));
  }
  [[nodiscard]] Sse2Lanes above_zero() const {
    return Sse2Lanes(_mm_cmpgt_epi8(lanes_, _mm_setzero_si128()));
  }
  // SSE2 has no maximum instruction for signed bytes, so this function compares and selects.
  [[nodiscard]] Sse2Lanes max(Sse2Lanes least) const {
    const __m128i below = _mm_cmplt_epi8(lanes_, least.lanes_);
    return Sse2Lanes(
        _mm_or_si128(_mm_and_si128(below, least.lanes_), _mm_andnot_si128(below, lanes_)));
  }
  [[nodiscard]] Sse2Lanes bit_or(Sse2Lanes other) const {
    return Sse2Lanes(_mm_or_si128(lanes_, other.lanes_));
  }
  [[nodiscard]] bool is_zero() const {
    return _mm_movemask_epi8(_mm_cmpeq_epi8(lanes_, _mm_setzero_si128())) == 0xFFFF;
  }
  static std::array<std::uint32_t, 4> negative(const std::array<Sse2Lanes, 4>& left,
                                               const std::array<Sse2Lanes, 4>& right) {
    std::array<std::uint32_t, 4> rows{};
    for (std::size_t y = 0; y < rows.size(); ++y) {
      rows[y] = static_cast<std::uint32_t>(_mm_movemask_epi8(left[y].lanes_)) |
                static_cast<std::uint32_t>(_mm_movemask_epi8(right[y].lanes_)) << kLaneCount;
    }
    return rows;
  }

  static std::array<Sse2Lanes, 4> rows_of(const LaneBytes* four) {
    const __m128i a = load(four[0]).lanes_;
    const __m128i b = load(four[1]).lanes_;
    const __m128i c = load(four[2]).lanes_;
    const __m128i d = load(four[3]).lanes_;
    const __m128i ab_low = _mm_unpacklo_epi32(a, b);
    const __m128i ab_high = _mm_unpackhi_epi32(a, b);
    const __m128i cd_low = _mm_unpacklo_epi32(c, d);
    const __m128i cd_high = _mm_unpackhi_epi32(c, d);
    return {Sse2Lanes(_mm_unpacklo_epi64(ab_low, cd_low)),
            Sse2Lanes(_mm_unpackhi_epi64(ab_low, cd_low)),
            Sse2Lanes(_mm_unpacklo_epi64(ab_high, cd_high)),
            Sse2Lanes(_mm_unpackhi_epi64(ab_high, cd_high))};
  }

 private:
  explicit Sse2Lanes(__m128i lanes) : lanes_(lanes) {}
  __m128i lanes_;
};

using Sse2RowPair = PlainRowPair;  // two words are as fast

}  // namespace iog::lanes
