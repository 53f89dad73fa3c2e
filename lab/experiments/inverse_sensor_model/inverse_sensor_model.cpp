// Table 4.1 of the thesis: the Bayesian approach by enumeration against Theorem 6.
#include "lab/reference/inverse_sensor_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "lab/experiments/experiments.hpp"
#include "sensor_model/single_target.hpp"

namespace iog::lab {
namespace {

using reference::Estimate;
using reference::Likelihoods;
using reference::LocalGrid;

constexpr int kLargestN = 18;
constexpr std::array kSigmasM{0.02, 0.10, 0.30};
constexpr std::array kCellLengthsM{0.025, 0.10, 0.50};

// Where z lies: in the first cell, in the middle one, on the far border of the last.
std::array<double, 3> measurements_of(const LocalGrid& grid) {
  return {grid.distance_m(1), grid.distance_m((grid.cells + 1) / 2),
          grid.cells * grid.cell_length_m};
}

// What was found for grids of one N.
struct Comparison {
  double largest_difference = 0;
  std::uint64_t configurations = 0;  // for one cell, the largest number
  std::uint64_t terms = 0;
};

void compare(const Likelihoods& seen, Comparison& found) {
  for (int i = 1; i <= static_cast<int>(seen.size()); ++i) {
    const Estimate slow = reference::enumerate_configurations(seen, i);
    const Estimate quick = reference::theorem_6(seen, i);
    found.largest_difference =
        std::max(found.largest_difference, std::fabs(slow.probability - quick.probability));
    found.configurations = std::max(found.configurations, slow.terms);
    found.terms = std::max(found.terms, quick.terms);
  }
}

Comparison compare_grids(int cells) {
  Comparison found;
  for (const double sigma_m : kSigmasM) {
    for (const double cell_length_m : kCellLengthsM) {
      const LocalGrid grid{.cells = cells, .cell_length_m = cell_length_m};
      for (const double z_m : measurements_of(grid)) {
        compare(reference::likelihoods({sigma_m}, grid, z_m), found);
      }
    }
  }
  return found;
}

// The largest difference of the firmware's Theorem 6, which knows neither the grid's ends nor the C
// library's exponential, to the one as printed, on a grid long enough around z.
double difference_of_firmware(double cell_length_sigmas) {
  double largest = 0;
  const LocalGrid grid{.cells = 200, .cell_length_m = 0.1 * cell_length_sigmas};
  const int k = 100;
  const Likelihoods seen = reference::likelihoods({0.1}, grid, grid.distance_m(k));
  const sensor_model::SingleTarget model{.sigma_m = 0.1, .cell_length_m = grid.cell_length_m};
  for (int offset = -32; offset <= 32; ++offset) {
    const double expected = reference::theorem_6(seen, k + offset).probability;
    largest = std::max(largest, std::fabs(model.probability(offset) - expected));
  }
  return largest;
}

Table enumeration() {
  Table table("inverse_sensor_model", {"cells", "difference_below", "configurations", "terms"});
  for (int cells = 2; cells <= kLargestN; ++cells) {
    const Comparison found = compare_grids(cells);
    table.row(cells, difference_bound(found.largest_difference), found.configurations, found.terms);
  }
  return table;
}

// The last cell of the local grid of a LUX: too many for an enumeration.
Table lux() {
  Table table("inverse_sensor_model_of_lux", {"cells", "terms"});
  const LocalGrid grid{.cells = 500, .cell_length_m = 0.10};
  const Likelihoods seen = reference::likelihoods({0.10}, grid, grid.distance_m(250));
  table.row(grid.cells, reference::theorem_6(seen, grid.cells).terms);
  return table;
}

Table firmware() {
  Table table("inverse_sensor_model_in_firmware", {"cell_length_sigmas", "difference_below"});
  for (const double cell_length_sigmas : {0.5, 1.0, 2.0, 4.0}) {
    table.row(cell_length_sigmas, difference_bound(difference_of_firmware(cell_length_sigmas)));
  }
  return table;
}

}  // namespace

Tables inverse_sensor_model(const Input& /*input*/) { return {enumeration(), lux(), firmware()}; }

}  // namespace iog::lab
