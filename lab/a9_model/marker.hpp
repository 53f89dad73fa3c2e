// How a program says to the model which part of it is to be reported: two DBG hints in a row, which
// are no operation on the processor and in QEMU, and which no compiler emits.
//
// The first carries bits 7 to 4 of a code, the second bits 3 to 0. Bit 7 is 0 at the beginning of a
// region and 1 at its end; the rest is its id. The model neither counts nor times the hints.
// Regions of different ids may nest or overlap.
#pragma once

#include <cstdint>

namespace iog::a9_model {

inline constexpr std::uint8_t kMarkerEnd = 0x80;
inline constexpr unsigned kRegionIds = 0x80;

// The end of region 127, which nobody may begin: what came before is not reported. A program that
// repeats itself has warmed up by then.
inline constexpr std::uint8_t kMarkerForget = kMarkerEnd | 0x7F;

// The end of region 126: a round is over. What each function cost in it is reported, too.
inline constexpr std::uint8_t kMarkerRound = kMarkerEnd | 0x7E;

// The ends of regions 125 and 124: what lies between them is not modelled, and takes a fifth of the
// time. Neither in a region nor in a function that is reported.
inline constexpr std::uint8_t kMarkerPause = kMarkerEnd | 0x7D;
inline constexpr std::uint8_t kMarkerResume = kMarkerEnd | 0x7C;

// Region 123: inside it, L2 allocates only in the ways that L2Cache::keep() leaves open.
inline constexpr std::uint8_t kMarkerKeepL2 = 0x7B;
inline constexpr std::uint8_t kMarkerReleaseL2 = kMarkerEnd | kMarkerKeepL2;

#if defined(__arm__)
template <unsigned kCode>
[[gnu::always_inline]] inline void mark() {
  __asm__ volatile("dbg %0\n\tdbg %1" ::"i"(kCode >> 4), "i"(kCode & 0xf) : "memory");
}

template <unsigned kId>
[[gnu::always_inline]] inline void begin_region() {
  static_assert(kId < kRegionIds - 5);
  mark<kId>();
}

template <unsigned kId>
[[gnu::always_inline]] inline void end_region() {
  static_assert(kId < kRegionIds - 5);
  mark<kId | kMarkerEnd>();
}

[[gnu::always_inline]] inline void forget_so_far() { mark<kMarkerForget>(); }
[[gnu::always_inline]] inline void end_round() { mark<kMarkerRound>(); }
[[gnu::always_inline]] inline void pause() { mark<kMarkerPause>(); }
[[gnu::always_inline]] inline void resume() { mark<kMarkerResume>(); }
[[gnu::always_inline]] inline void keep_l2() { mark<kMarkerKeepL2>(); }
[[gnu::always_inline]] inline void release_l2() { mark<kMarkerReleaseL2>(); }
#endif

}  // namespace iog::a9_model
