// Defines ARM-state NEON loads and stores that post-increment their pointer. This header also
// defines operations that take one instruction here, but would take two or three if left to the
// compiler. CMake generates lanes/moves_neon.hpp as a copy of this header or of moves_a64_neon.hpp.
#pragma once

#include <arm_neon.h>
#include <array>
#include <cstddef>
#include <cstdint>

namespace iog::lanes {

inline poly8x8_t load_next_eight(const std::byte*& from) {
  using Eight = const std::byte[8];  // any data that is read
  poly8x8_t eight;
  asm("vld1.8 {%P[eight]}, [%[from]]!"
      : [eight] "=w"(eight), [from] "+r"(from)
      : "m"(*reinterpret_cast<Eight*>(from)));
  return eight;
}

// T is 32 bytes long and is aligned to 32 bytes.
template <typename T>
inline poly8x16x2_t load_next_pair(const T*& from) {
  static_assert(sizeof(T) == sizeof(poly8x16x2_t) && alignof(T) == sizeof(T));
  poly8x16x2_t pair;
  asm("vld1.8 %h[pair], [%[from] :256]!" : [pair] "=w"(pair), [from] "+r"(from) : "m"(*from));
  return pair;
}

// T has eight values of 16 bits and is aligned to 16 bytes. Without asm, the compiler would use two
// half-register loads with offsets.
template <typename T>
inline int16x8_t load_next(const T*& from) {
  static_assert(sizeof(T) == sizeof(int16x8_t) && alignof(T) >= sizeof(T));
  int16x8_t lanes;
  asm("vld1.64 {%e[lanes]-%f[lanes]}, [%[from] :128]!"
      : [lanes] "=w"(lanes), [from] "+r"(from)
      : "m"(*from));
  return lanes;
}

template <typename T>
inline void store_next(int16x8_t lanes, T*& to) {
  static_assert(sizeof(T) == sizeof(int16x8_t) && alignof(T) >= sizeof(T));
  asm("vst1.64 {%e[lanes]-%f[lanes]}, [%[to] :128]!"
      : [to] "+r"(to), "=m"(*to)
      : [lanes] "w"(lanes));
}

// Stores eight bytes and advances the pointer by `count`.
inline void store_some(uint8x8_t bytes, std::uint32_t count, std::uint8_t*& to) {
  using Eight = std::uint8_t[8];
  asm("vst1.8 {%P[bytes]}, [%[to]], %[count]"
      : [to] "+r"(to), "=m"(*reinterpret_cast<Eight*>(to))
      : [bytes] "w"(bytes), [count] "r"(count));
}

// Returns `others` in lanes where `is_other` is set, and `cells` in all other lanes. Without asm,
// the compiler would copy a register first.
inline uint8x16_t replaced(uint8x16_t cells, uint8x16_t others, uint8x16_t is_other) {
  asm("vbit %q[cells], %q[others], %q[is_other]"
      : [cells] "+w"(cells)
      : [others] "w"(others), [is_other] "w"(is_other));
  return cells;
}

// Adds two 1024-bit numbers: sum := a + b. The carry is held in the flags, so no other instruction
// here may change the flags.
inline void add(const std::array<std::uint32_t, 32>& a, const std::array<std::uint32_t, 32>& b,
                std::array<std::uint32_t, 32>& sum) {
  const std::uint32_t* from_a = a.data();
  const std::uint32_t* from_b = b.data();
  std::uint32_t* to = sum.data();
  asm("adds r0, r0, #0\n"
      ".rept 8\n"
      "ldm %[a]!, {r0, r1, r2, r3}\n"
      "ldm %[b]!, {r4, r5, r6, r8}\n"
      "adcs r0, r0, r4\n"
      "adcs r1, r1, r5\n"
      "adcs r2, r2, r6\n"
      "adcs r3, r3, r8\n"
      "stm %[to]!, {r0, r1, r2, r3}\n"
      ".endr\n"
      : [a] "+r"(from_a), [b] "+r"(from_b), [to] "+r"(to), "=m"(sum)
      :
      : "r0", "r1", "r2", "r3", "r4", "r5", "r6", "r8", "cc", "memory");
}

// Copies 16 bytes from `left`, and then 16 bytes from `right`. All pointers advance by the length
// of a row, 32 bytes. All pointers are aligned to 16 bytes.
inline void copy_next_halves(const std::int8_t*& left, const std::int8_t*& right,
                             std::int8_t*& to) {
  constexpr std::int32_t kRow = 32;
  using Row = std::int8_t[kRow];  // the data that is written
  int8x16_t one;
  int8x16_t other;
  asm("vld1.8 {%e[one]-%f[one]}, [%[left] :128], %[row]\n\t"
      "vld1.8 {%e[other]-%f[other]}, [%[right] :128], %[row]\n\t"
      "vst1.8 {%e[one]-%f[one]}, [%[to] :128]!\n\t"
      "vst1.8 {%e[other]-%f[other]}, [%[to] :128]!"
      : [one] "=&w"(one), [other] "=&w"(other), [left] "+r"(left), [right] "+r"(right),
        [to] "+r"(to), "=m"(*reinterpret_cast<Row*>(to))
      : [row] "r"(kRow)
      : "memory");
}

// Returns `cells + stride * (fine_row >> 16)`, computed in one instruction. The absolute value of
// `stride` must be less than 2^15.
inline const std::int8_t* row_at(const std::int8_t* cells, std::int32_t fine_row,
                                 std::int32_t stride) {
  const std::int8_t* row;
  asm("smlatb %[row], %[fine_row], %[stride], %[cells]"
      : [row] "=r"(row)
      : [fine_row] "r"(fine_row), [stride] "r"(stride), [cells] "r"(cells));
  return row;
}

}  // namespace iog::lanes
