// Discounting: how a mass function loses trust (Kurdej 2015, section 3.5.3 and chapter 6).
//
// Where the printed equations cannot be what is meant there are both. Meant is what the thesis's
// text, its table 6.1 and the first line of equation 6.19 say: a set keeps a product of factors,
// each in 0 ... 1, and what all sets lose is the frame's.
#pragma once

#include <cstdint>
#include <span>

#include "lab/reference/evidential/mass_function.hpp"

namespace iog::lab::reference::evidential {

// alpha of theta: the share that is lost, 0 ... 1.
struct Rate {
  Set theta = 0;
  double alpha = 0;
};
using Rates = std::span<const Rate>;

enum class Scheme : std::uint8_t { kConservative, kOptimistic, kProportional };

// Equations 3.49 and 3.50.
[[nodiscard]] MassFunction discounted_classically(const MassFunction& mass, double alpha);

// Mercier's: alpha of theta discounts what is not in theta, towards unions with theta (equations
// 6.12 to 6.14). Any alpha is computed with, also the negative one of case C1.
[[nodiscard]] MassFunction contextual_mass(int elements, Rates rates);  // m_Theta
[[nodiscard]] MassFunction discounted_contextually(const MassFunction& mass, Rates rates);

// The thesis's three schemes as they are meant.
[[nodiscard]] MassFunction discounted(const MassFunction& mass, Scheme scheme, Rates rates);

// The same as printed: equations 6.20 to 6.22, 6.23 to 6.25, and 6.29 to 6.31.
[[nodiscard]] MassFunction discounted_as_printed(const MassFunction& mass, Scheme scheme,
                                                 Rates rates);

}  // namespace iog::lab::reference::evidential
