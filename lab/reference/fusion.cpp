#include "lab/reference/fusion.hpp"

#include <cmath>

namespace iog::lab::reference {

double fuse_bayes(double p, double q) { return p * q / (p * q + (1 - p) * (1 - q)); }

double log_odds(double p) { return std::log(p / (1 - p)); }

// Equation 2.47 prints 1 - 1 / (1 + exp(l)). That is the same number, but as written it has lost
// its last digits where the probability is near 0.
double probability_of_log_odds(double l) { return 1 / (1 + std::exp(-l)); }

}  // namespace iog::lab::reference
