// The fusion of occupancy probabilities of one cell, as the literature has it (thesis section 2.4).
#pragma once

namespace iog::tools::reference {

// Bayesian fusion of two independent measurements under the non-informative prior (equations 2.44
// and 3.2). 0 < p, q < 1.
[[nodiscard]] double fuse_bayes(double p, double q);

}  // namespace iog::tools::reference
