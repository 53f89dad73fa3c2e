// Exponential decay of evidence (Kurdej 2015, chapter 6), with one time constant for moving objects
// and one for static ones.
#pragma once

#include <cstdint>

#include "evidence/factors.hpp"

namespace iog::ageing {

// How the factors of occupied sets follow from those of moving and of static objects.
enum class Discounting : std::uint8_t {
  kConservative,  // {I, M, S, U} decays by both
  kOptimistic,    // {I, M, S, U} does not decay
  kClassical,     // everything decays like moving objects
  kProportional,  // {I, M, S, U} by shares: one quarter moving, three static
};

// After more than this many milliseconds nothing is left.
inline constexpr std::uint32_t kLongestMs = 65'535;

// The decay after a time; none after 0 ms.
evidence::Fading left_after(std::uint32_t ms, Discounting discounting);

}  // namespace iog::ageing
