#include "lab/reference/evidential/temporal_discounting.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

namespace iog::lab::reference::evidential {

std::vector<double> decay_rates(std::span<const double> half_lives_s) {
  std::vector<double> rates;
  for (const double half_life_s : half_lives_s) {
    rates.push_back(std::numbers::ln2 / half_life_s);
  }
  return rates;
}

std::vector<double> left_after(double t_s, std::span<const double> decay_rates) {
  std::vector<double> kappas;
  for (const double rate : decay_rates) {
    kappas.push_back(std::exp(-rate * t_s));
  }
  return kappas;
}

std::vector<double> contextual_rates(std::span<const double> kappas) {
  const auto count = static_cast<double>(kappas.size());
  const double product =
      std::accumulate(kappas.begin(), kappas.end(), 1.0, std::multiplies<double>());
  std::vector<double> alphas;
  for (const double kappa : kappas) {
    const double radicand = product / kappa / std::pow(kappa, count - 2);
    alphas.push_back(1 - std::pow(radicand, 1 / (count - 1)));
  }
  return alphas;
}

}  // namespace iog::lab::reference::evidential
