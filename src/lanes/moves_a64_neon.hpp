// The A64 version of moves_a32_neon.hpp. This version uses intrinsics, which gcc compiles to loads
// and stores that post-increment their pointer.
#pragma once

#include <arm_neon.h>
#include <array>
#include <cstddef>
#include <cstdint>

namespace iog::lanes {

inline poly8x8_t load_next_eight(const std::byte*& from) {
  const poly8x8_t eight = vld1_p8(reinterpret_cast<const poly8_t*>(from));
  from += sizeof(eight);
  return eight;
}

template <typename T>
inline poly8x16x2_t load_next_pair(const T*& from) {
  static_assert(sizeof(T) == sizeof(poly8x16x2_t));
  const auto* const bytes = reinterpret_cast<const poly8_t*>(from);
  ++from;
  return {{vld1q_p8(bytes), vld1q_p8(bytes + sizeof(poly8x16_t))}};
}

template <typename T>
inline int16x8_t load_next(const T*& from) {
  static_assert(sizeof(T) == sizeof(int16x8_t));
  return vld1q_s16((from++)->data());
}

template <typename T>
inline void store_next(int16x8_t lanes, T*& to) {
  static_assert(sizeof(T) == sizeof(int16x8_t));
  vst1q_s16((to++)->data(), lanes);
}

inline void store_some(uint8x8_t bytes, std::uint32_t count, std::uint8_t*& to) {
  vst1_u8(to, bytes);
  to += count;
}

inline uint8x16_t replaced(uint8x16_t cells, uint8x16_t others, uint8x16_t is_other) {
  return vbslq_u8(is_other, others, cells);
}

// Adds 64 bits at a time.
inline void add(const std::array<std::uint32_t, 32>& a, const std::array<std::uint32_t, 32>& b,
                std::array<std::uint32_t, 32>& sum) {
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < sum.size(); i += 2) {
    const auto wide = [i](const auto& words) {
      return words[i] | std::uint64_t{words[i + 1]} << 32;
    };
    std::uint64_t part = 0;
    const bool over = __builtin_add_overflow(wide(a), wide(b), &part);
    const bool carried = __builtin_add_overflow(part, carry, &part);
    sum[i] = static_cast<std::uint32_t>(part);
    sum[i + 1] = static_cast<std::uint32_t>(part >> 32);
    carry = std::uint64_t{over || carried};
  }
}

inline void copy_next_halves(const std::int8_t*& left, const std::int8_t*& right,
                             std::int8_t*& to) {
  constexpr std::ptrdiff_t kRow = 32;
  vst1q_s8(to, vld1q_s8(left));
  vst1q_s8(to + kRow / 2, vld1q_s8(right));
  left += kRow;
  right += kRow;
  to += kRow;
}

inline const std::int8_t* row_at(const std::int8_t* cells, std::int32_t fine_row,
                                 std::int32_t stride) {
  return cells + (fine_row >> 16) * stride;
}

}  // namespace iog::lanes
