// What is left of evidence after a time (Kurdej 2015, chapter 6): exponential decay, with one time
// constant for what moves and one for what stands.
#pragma once

#include <cstdint>

#include "evidence/factors.hpp"

namespace iog::ageing {

// How the factors of occupied sets follow from those of what moves and of what stands.
enum class Discounting : std::uint8_t {
  kConservative,  // {I, M, S, U} loses by both
  kOptimistic,    // {I, M, S, U} loses nothing
  kClassical,     // everything like what moves
  kProportional,  // {I, M, S, U} by its shares: one quarter moves, three stand
};

// After more than this many milliseconds nothing is left.
inline constexpr std::uint32_t kLongestMs = 65'535;

// After 0 ms everything is left as it is.
evidence::Fading left_after(std::uint32_t ms, Discounting discounting);

}  // namespace iog::ageing
