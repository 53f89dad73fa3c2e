// The inverse sensor model of a single-target range sensor, according to Theorem 6 of the thesis
// (page 91).
//
//   P(o_i | z) = ( sum_{h<i} p(z|d_h) * 2^-h  +  p(z|d_i) * 2^-(i-1) ) / alpha
//   alpha      =   sum_h p(z|d_h) * 2^-(h-1)
//
// p(z|d) is a Gaussian with standard deviation sigma around d, with the usual factor 1/2 in the
// exponent. Equation 4.1 omits this factor, but Table 4.3 needs it (docs/model.md section 4).
// Distances are measured to the centres of cells, and z is assumed to be at the centre of cell k,
// which contains it. The result therefore depends only on i - k and on the ratio of the cell length
// to sigma, unless k is within a few cells of either end of the grid.
#pragma once

#include "numeric/elementary.hpp"

namespace iog::sensor_model {

struct SingleTarget {
  double sigma_m;        // standard deviation of the range, > 0
  double cell_length_m;  // length of a 1D cell, > 0 and at most 4 sigma

  // Returns P(o_(k + offset) | z in cell k). Requires |offset| <= 32.
  [[nodiscard]] constexpr double probability(int offset) const {
    double before = 0;
    double alpha = 0;
    for (int h = -reach(); h <= reach(); ++h) {
      // Here, h is counted from cell k. This omits the factor 2^-(k-1), which cancels in the
      // quotient.
      const double weighted = likelihood(h) * numeric::power_of_two(-h);
      alpha += weighted;
      if (h < offset) {
        before += weighted / 2;
      }
    }
    return (before + likelihood(offset) * numeric::power_of_two(-offset)) / alpha;
  }

 private:
  // Returns the number of cells to sum on each side. The powers of two shift the maximum term by
  // sigma^2 * ln(2) / cell^2 cells. A term that is 12 sigma away from the maximum term is less than
  // 1e-30 times as large.
  [[nodiscard]] constexpr int reach() const {
    const double ratio = sigma_m / cell_length_m;
    return 40 + static_cast<int>(14 * ratio + ratio * ratio);
  }

  // Returns p(z|d) for the cell at the given offset, up to a constant factor that cancels.
  [[nodiscard]] constexpr double likelihood(int offset) const {
    const double distance = offset * cell_length_m / sigma_m;
    const double exponent = -0.5 * distance * distance;
    return exponent < -690 ? 0 : numeric::exp(exponent);
  }
};

}  // namespace iog::sensor_model
