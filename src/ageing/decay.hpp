// Computes the decay of a mass after a given time, as a product over the bits of the time.
//
// The decay after a time t is kappa(t) = exp(-t / tau). A table contains floor(2^31 * kappa(2^j
// ms)) for each bit j. The factors of the bits that are set in t are multiplied, starting with the
// lowest bit, and each product is rounded down. All factors and products are below 1, and rounding
// reduces each of them by less than one unit of 2^-31. With up to 16 factors and 15 products, the
// computed kappa(t) is therefore at most 16 + 15 units below the true value.
//
// Factors are below 2^31, so the product of two factors is below 2^62.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "numeric/elementary.hpp"

namespace iog::ageing {

inline constexpr int kDecayFraction = 31;

// The factor 1, which means no decay.
inline constexpr std::uint32_t kUndecayed = std::uint32_t{1} << kDecayFraction;

// Entry j is the factor for 2^j ms, which is bit j of a time in ms.
using DecayTable = std::array<std::uint32_t, 16>;

// Returns 1 / tau. The argument is the fraction of a mass that is left after 100 ms. This function
// runs only on a PC or at compile time. Kurdej 2015, table 7.1, specifies losses of 0.01 and 0.10
// per scan for contextual discounting. In contextual discounting, a rate applies to the complement
// of a set, so the two rates are swapped here.
constexpr double rate_per_ms(double left_after_100_ms) {
  return -numeric::log(left_after_100_ms) / 100;
}
inline constexpr double kDynamicRate = rate_per_ms(0.90);  // tau = 0.949 s
inline constexpr double kStaticRate = rate_per_ms(0.99);   // tau = 9.950 s

constexpr DecayTable make_decay(double rate) {
  DecayTable table{};
  for (std::size_t j = 0; j < table.size(); ++j) {
    const auto ms = static_cast<double>(std::uint32_t{1} << j);
    table[j] = static_cast<std::uint32_t>(numeric::exp(-rate * ms) * kUndecayed);
  }
  return table;
}

// Both arguments must be at most 2^31.
constexpr std::uint32_t product(std::uint32_t a, std::uint32_t b) {
  return static_cast<std::uint32_t>((std::uint64_t{a} * b) >> kDecayFraction);
}

// The argument must be in the range 0 ... 65535.
constexpr std::uint32_t decay(const DecayTable& table, std::uint32_t ms) {
  std::uint32_t left = kUndecayed;
  for (std::uint32_t rest = ms; rest != 0; rest &= rest - 1) {
    left = product(left, table[static_cast<std::size_t>(std::countr_zero(rest))]);
  }
  return left;
}

struct Decays {
  DecayTable dynamic{};
  DecayTable fixed{};
  // The factor kappa_dyn^(1/4) * kappa_sta^(3/4). This factor is the limit that the proportional
  // factor (Kurdej 2015, section 6.3) approaches as the time steps become shorter. With finite time
  // steps, the decay would depend on the update rate.
  DecayTable shared{};
  friend constexpr bool operator==(const Decays&, const Decays&) = default;
};

constexpr Decays make_decays(double dynamic_rate, double static_rate) {
  return {.dynamic = make_decay(dynamic_rate),
          .fixed = make_decay(static_rate),
          .shared = make_decay(dynamic_rate / 4 + static_rate * 3 / 4)};
}
inline constexpr Decays kUsualDecays = make_decays(kDynamicRate, kStaticRate);

}  // namespace iog::ageing
