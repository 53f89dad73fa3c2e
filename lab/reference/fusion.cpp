#include "lab/reference/fusion.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace iog::lab::reference {

double fuse_bayes(double p, double q) { return p * q / (p * q + (1 - p) * (1 - q)); }

double log_odds(double p) { return std::log(p / (1 - p)); }

// Equation 2.47 prints 1 - 1 / (1 + exp(l)). That is the same number, but as written it has lost
// its last digits where the probability is near 0.
double probability_of_log_odds(double l) { return 1 / (1 + std::exp(-l)); }

double fuse_log_odds(double p, double q) {
  return probability_of_log_odds(log_odds(p) + log_odds(q));
}

double fuse_linear_opinion_pool(std::span<const double> probabilities,
                                std::span<const double> weights) {
  return std::inner_product(probabilities.begin(), probabilities.end(), weights.begin(), 0.0);
}

double fuse_linear_opinion_pool(std::span<const double> probabilities) {
  const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
  return sum / static_cast<double>(probabilities.size());
}

double fuse_maximum(double p, double q) { return std::max(p, q); }

}  // namespace iog::lab::reference
