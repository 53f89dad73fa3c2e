// Figure 3.6 of the thesis, and what its section 3.4.6.3 says of the range that an index needs.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "index/recursive_set.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/reference/fusion.hpp"

namespace iog::lab {
namespace {

constexpr std::array kFigureEpsilons{0.05, 0.01, 0.005};
constexpr std::array kTableEpsilons{0.1, 0.05, 0.01, 0.005, 1e-3, 1e-4, 1e-5, 1e-6};
constexpr std::array kTails{1e-3, 1e-6, 1e-11};
constexpr int kByteIndexes = 127;

// l(p_1): the log-odds of p_n are n times those of p_1 = 1/2 + epsilon.
double log_odds_step(double epsilon) { return 2 * std::atanh(2 * epsilon); }

// 1 - p_n without its cancellation: a double near 1 has only 16 digits behind the point to tell
// 1 - p_127 = 8.55e-12 from 0, its log-odds have them all.
double complement(double epsilon, int n) { return 1 / (1 + std::exp(n * log_odds_step(epsilon))); }

// The smallest M with p_-M <= tail, and so p_M >= 1 - tail.
double indexes_to_tail(double epsilon, double tail) {
  return std::ceil((std::log1p(-tail) - std::log(tail)) / log_odds_step(epsilon));
}

int bytes_of_index(double largest) {
  if (largest <= std::numeric_limits<std::int8_t>::max()) {
    return 1;
  }
  return largest <= std::numeric_limits<std::int16_t>::max() ? 2 : 4;
}

// How many elements lie in [0.05, 0.95].
int elements_between(const index::RecursiveSet& set) {
  int n = 0;
  while (set.probability(n + 1) <= 0.95) {
    ++n;
  }
  return 2 * n + 1;
}

// The largest |a_n - p_n|, |b_n - p_-n| up to 127, a_n and b_n by the recursion of theorem 3.
double difference_to_recursion(double epsilon) {
  const index::RecursiveSet set(epsilon);
  double a = 0.5;
  double b = 0.5;
  double largest = 0;
  for (int n = 1; n <= kByteIndexes; ++n) {
    a = reference::fuse_bayes(a, 0.5 + epsilon);
    b = reference::fuse_bayes(b, 0.5 - epsilon);
    largest = std::fmax(largest, std::fabs(a - set.probability(n)));
    largest = std::fmax(largest, std::fabs(b - set.probability(-n)));
  }
  return largest;
}

// p_n of the sets of figure 3.6.
Table elements() {
  Table table("recursive_sets", {"epsilon", "n", "p"});
  for (const double epsilon : kFigureEpsilons) {
    const index::RecursiveSet set(epsilon);
    for (int n = -kByteIndexes; n <= kByteIndexes; ++n) {
      table.row(epsilon, n, set.probability(n));
    }
  }
  return table;
}

Table properties() {
  Table table("recursive_set_properties",
              {"epsilon", "complement_of_p_127", "elements_in_005_to_095",
               "largest_difference_to_theorem_3"});
  for (const double epsilon : kFigureEpsilons) {
    table.row(epsilon, complement(epsilon, kByteIndexes),
              elements_between(index::RecursiveSet(epsilon)), difference_to_recursion(epsilon));
  }
  return table;
}

// How long a look-up table from indexes to probabilities must be, and the index of one passing
// beam: the floor of 0.05, blurred.
Table ranges() {
  Table table("recursive_set_ranges",
              {"epsilon", "tail", "largest_index", "index_bytes", "free_index"});
  for (const double epsilon : kTableEpsilons) {
    const int free = index::RecursiveSet(epsilon).quantise(0.05, index::Quantisation::kBlurring);
    for (const double tail : kTails) {
      const double largest = indexes_to_tail(epsilon, tail);
      table.row(epsilon, tail, largest, bytes_of_index(largest), free);
    }
  }
  return table;
}

}  // namespace

Tables recursive_sets(const Input& /*input*/) { return {elements(), properties(), ranges()}; }

}  // namespace iog::lab
