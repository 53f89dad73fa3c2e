// The inverse sensor model (ISM) of a single-target range sensor on a local 1D grid, in the three
// forms that the papers compare: Elfes' sum over all grid configurations (thesis section 2.3.1.1),
// Theorem 6 (thesis page 91), and the analytic model of the many-core paper (equation 4 there).
//
// Cells are counted from 1, as in the thesis; cell 1 is the nearest to the sensor. z and d are
// distances from the sensor. Sums are long double: 2^-h of the two-thousandth cell is no double.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace iog::lab::reference {

// The exponent of the Gaussian sensor model.
enum class Exponent : std::uint8_t {
  kHalved,     // -(z - d)^2 / (2 sigma^2), the usual one: docs/model.md section 4
  kAsPrinted,  // -(z - d)^2 / sigma^2: equation 4.1
};

struct RangeSensor {
  double sigma_m = 0.10;  // > 0
  Exponent exponent = Exponent::kHalved;

  // p(z|d), per metre, with the factor 1 / sqrt(2 pi sigma^2) that equation 4.1 has.
  [[nodiscard]] long double likelihood(double z_m, double d_m) const;
};

struct LocalGrid {
  int cells = 1;                // N, at least 1
  double cell_length_m = 0.10;  // > 0

  // d_i, the distance of the centre of cell i.
  [[nodiscard]] double distance_m(int i) const { return (i - 0.5) * cell_length_m; }
};

// p(z|d_i) of every cell of a grid, that of cell i at [i - 1]. At least one must be above 0 for
// what follows.
using Likelihoods = std::vector<long double>;
[[nodiscard]] Likelihoods likelihoods(const RangeSensor& sensor, const LocalGrid& grid, double z_m);

struct Estimate {
  double probability = 0.5;  // P(o_i|z)
  std::uint64_t terms = 0;   // how many were added up to find it
};

// P(o_i|z) by enumeration of the 2^(N-1) grid configurations in which cell i is occupied, and of
// the 2^(N-1) in which it is empty (equations 2.29 to 2.34). N <= 30; 2^N terms.
[[nodiscard]] Estimate enumerate_configurations(const Likelihoods& likelihoods, int i);

// P(o_i|z) by Theorem 6 as it is printed; i terms above, N below.
[[nodiscard]] Estimate theorem_6(const Likelihoods& likelihoods, int i);

// p(o_d|z) of the many-core paper: a Gaussian of amplitude lambda(d) and standard deviation
// sigma_d around z, not below the free distribution before z, not below 1/2 behind it.
struct AnalyticModel {
  std::function<double(double d_m)> lambda;   // 1/2 < lambda(d) < 1
  std::function<double(double d_m)> sigma_m;  // > 0
  // How likely a cell before the range is occupied all the same. (The paper's text calls it
  // p(not o_d|z), which cannot be meant: the curve it draws is near 0 there.)
  std::function<double(double d_m, double z_m)> free;

  [[nodiscard]] double probability(double d_m, double z_m) const;
};

}  // namespace iog::lab::reference
