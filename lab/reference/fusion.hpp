// The fusion of occupancy probabilities of one cell, as the literature has it (thesis section 2.4).
#pragma once

namespace iog::lab::reference {

// Bayesian fusion of two independent measurements under the non-informative prior (equations 2.44
// and 3.2). 0 < p, q < 1.
[[nodiscard]] double fuse_bayes(double p, double q);

// The same as a sum of log-odds: l(p) = log(p / (1 - p)) (equation 2.46), and back (equation 2.47).
// 0 < p, q < 1; any l.
[[nodiscard]] double log_odds(double p);
[[nodiscard]] double probability_of_log_odds(double l);

}  // namespace iog::lab::reference
