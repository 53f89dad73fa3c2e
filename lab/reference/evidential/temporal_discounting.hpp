// Discounting by age: evidence decays like a radioactive substance, each class with a half-life of
// its own (Kurdej 2015, sections 6.1 and 6.6). All spans are as long as each other.
#pragma once

#include <span>
#include <vector>

namespace iog::lab::reference::evidential {

// Half-lives in seconds to decay rates in 1/s (equation 6.3).
[[nodiscard]] std::vector<double> decay_rates(std::span<const double> half_lives_s);

// kappa, what is left of each class after t (equation 6.52).
[[nodiscard]] std::vector<double> left_after(double t_s, std::span<const double> decay_rates);

// alpha, the rates by which contextual discounting leaves kappa of each of K >= 2 singletons
// (equation 6.51). Negative ones say that it cannot.
[[nodiscard]] std::vector<double> contextual_rates(std::span<const double> kappas);

}  // namespace iog::lab::reference::evidential
