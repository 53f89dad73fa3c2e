#include "lab/reference/inverse_sensor_model.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace iog::lab::reference {
namespace {

// p(z|g): what the sensor sees of a configuration is its first occupied cell (equation 2.34). Bit
// h - 1 of a configuration says that cell h is occupied.
//
// One configuration has no occupied cell, and equation 2.34 no h for it. A single-target sensor
// has no range to return then, so that p(z|g) = 0 for every z. The thesis does the same without
// saying so: the configurations counted in equation B.9 are 2^(N-1) - 1.
long double likelihood_of(std::uint32_t configuration, const Likelihoods& likelihoods) {
  if (configuration == 0) {
    return 0;
  }
  return likelihoods[static_cast<std::size_t>(std::countr_zero(configuration))];
}

}  // namespace

long double RangeSensor::likelihood(double z_m, double d_m) const {
  const auto sigma = static_cast<long double>(sigma_m);
  const auto deviations = static_cast<long double>(z_m - d_m) / sigma;
  const long double factor = exponent == Exponent::kHalved ? 0.5L : 1.0L;
  const long double root = std::sqrt(2 * std::numbers::pi_v<long double>);
  return std::exp(-factor * deviations * deviations) / (root * sigma);
}

Likelihoods likelihoods(const RangeSensor& sensor, const LocalGrid& grid, double z_m) {
  Likelihoods values;
  values.reserve(static_cast<std::size_t>(grid.cells));
  for (int i = 1; i <= grid.cells; ++i) {
    values.push_back(sensor.likelihood(z_m, grid.distance_m(i)));
  }
  return values;
}

Estimate enumerate_configurations(const Likelihoods& likelihoods, int i) {
  const std::uint32_t configurations = 1U << likelihoods.size();
  const std::uint32_t cell = 1U << (i - 1);
  long double occupied = 0;  // p(z|o_i) and p(z|e_i), without the common factor P(g) = 2^-(N-1)
  long double empty = 0;
  for (std::uint32_t configuration = 0; configuration < configurations; ++configuration) {
    const bool is_occupied = (configuration & cell) != 0;
    (is_occupied ? occupied : empty) += likelihood_of(configuration, likelihoods);
  }
  return {.probability = static_cast<double>(occupied / (occupied + empty)),
          .terms = configurations};
}

Estimate theorem_6(const Likelihoods& likelihoods, int i) {
  Estimate estimate;
  const auto weighted = [&](int h, int power) {
    ++estimate.terms;
    return std::ldexp(likelihoods[static_cast<std::size_t>(h) - 1], -power);
  };
  long double alpha = 0;
  for (int h = 1; h <= static_cast<int>(likelihoods.size()); ++h) {
    alpha += weighted(h, h - 1);
  }
  long double sum = 0;
  for (int h = 1; h < i; ++h) {
    sum += weighted(h, h);
  }
  sum += weighted(i, i - 1);  // for i = 1 all there is: p(z|d_1)
  estimate.probability = static_cast<double>(sum / alpha);
  return estimate;
}

double AnalyticModel::probability(double d_m, double z_m) const {
  const double deviations = (d_m - z_m) / sigma_m(d_m);
  const double gaussian = lambda(d_m) * std::exp(-0.5 * deviations * deviations);
  return d_m <= z_m ? std::max(free(d_m, z_m), gaussian) : std::max(0.5, gaussian);
}

}  // namespace iog::lab::reference
