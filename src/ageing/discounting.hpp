// The exponential decay of evidence (Kurdej 2015, chapter 6), with separate time constants for
// moving and static objects.
#pragma once

#include <cstdint>

#include "ageing/decay.hpp"
#include "evidence/factors.hpp"

namespace iog::ageing {

// Defines how the ageing factors of occupied sets are derived from those of moving and static
// objects.
enum class Discounting : std::uint8_t {
  kConservative,  // {I, M, S, U} decays with both factors
  kOptimistic,    // {I, M, S, U} does not decay
  kClassical,     // everything decays like moving objects
  kProportional,  // {I, M, S, U} decays with weights of 1/4 for moving and 3/4 for static objects
};

// Returns the ageing factors after `ms` milliseconds. After 0 ms, masses have not decayed. After
// more than 65,535 ms, all masses are 0.
evidence::Fading left_after(std::uint32_t ms, Discounting discounting,
                            const Decays& decays = kUsualDecays);

}  // namespace iog::ageing
