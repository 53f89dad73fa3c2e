#include "lab/experiments/cell_length.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "index/recursive_set.hpp"
#include "lab/reference/inverse_sensor_model.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;
using reference::Exponent;

constexpr double kSigmaM = 0.10;
constexpr double kEpsilon = 0.05;
constexpr std::array kCellLengthsM{0.5, 0.1, 0.025};  // figures 4.6b, 4.6c, 4.6d

// A cell's ISM, where the cell lies by its distance from the centre of cell k.
struct CellModel {
  double from_z_m = 0;
  double ism = 0;
};

// The ISM of the thesis's local grid of 50 m around z, the centre of the first cell behind 25 m. As
// far as 1.5 m from z; beyond, it is 0 and 1/2.
std::vector<CellModel> models_around_z(double cell_length_m, Exponent exponent) {
  const auto cells_in = [&](double length_m) {
    return static_cast<int>(std::lround(length_m / cell_length_m));
  };
  const reference::LocalGrid grid{.cells = cells_in(50), .cell_length_m = cell_length_m};
  const int k = cells_in(25) + 1;
  const int reach = cells_in(1.5);
  const auto seen = reference::likelihoods({kSigmaM, exponent}, grid, grid.distance_m(k));
  std::vector<CellModel> models;
  for (int offset = -reach; offset <= reach; ++offset) {
    models.push_back({.from_z_m = offset * cell_length_m,
                      .ism = reference::theorem_6(seen, k + offset).probability});
  }
  return models;
}

double peak_of(double cell_length_m, Exponent exponent) {
  double largest = 0;
  for (const CellModel& cell : models_around_z(cell_length_m, exponent)) {
    largest = std::max(largest, cell.ism);
  }
  return largest;
}

// Thesis section 4.2.1.2; of the middle length it says nothing there, but has 0.6 in table 4.3.
std::string paper_on_peak(double cell_length_m) {
  if (cell_length_m > 0.2) {
    return "close to 1";
  }
  return cell_length_m > 0.05 ? "0.6" : "does not overtake 1/2";
}

// Figure 4.6a.
Plot figure_4_6_a() {
  Plot plot{.title = "Sensor model for d = 25 m, sigma = 0.10 m (figure 4.6a)",
            .x_label = "z, m",
            .y_label = "p(z|d), 1/m",
            .series = {}};
  for (const Exponent exponent : {Exponent::kHalved, Exponent::kAsPrinted}) {
    const bool is_halved = exponent == Exponent::kHalved;
    Series series{.name = is_halved ? "usual exponent" : "equation 4.1 as printed", .points = {}};
    for (int i = -100; i <= 100; ++i) {
      const double z_m = 25 + 0.005 * i;
      const reference::RangeSensor sensor{kSigmaM, exponent};
      series.points.emplace_back(z_m, static_cast<double>(sensor.likelihood(z_m, 25)));
    }
    plot.series.push_back(series);
  }
  return plot;
}

// Each cell is drawn over its length.
Series profile_of(double cell_length_m) {
  Series series{.name = "cells of " + fixed(cell_length_m, 3) + " m",
                .points = {},
                .style = Series::Style::kSteps};
  for (const CellModel& cell : models_around_z(cell_length_m, Exponent::kHalved)) {
    series.points.emplace_back(cell.from_z_m - cell_length_m / 2, cell.ism);
  }
  const auto [last_x, last_y] = series.points.back();
  series.points.emplace_back(last_x + cell_length_m, last_y);
  return series;
}

Plot figure_4_6_b_to_d() {
  Plot plot{.title = "ISM for z = 25 m, sigma = 0.10 m (figures 4.6b to 4.6d)",
            .x_label = "distance from z, m",
            .y_label = "P(o_i|z)",
            .series = {}};
  for (const double cell_length_m : kCellLengthsM) {
    plot.series.push_back(profile_of(cell_length_m));
  }
  return plot;
}

void print_peaks(Markdown& body) {
  std::vector<std::vector<std::string>> rows;
  for (const double cell_length_m : kCellLengthsM) {
    const double usual = peak_of(cell_length_m, Exponent::kHalved);
    const double printed = peak_of(cell_length_m, Exponent::kAsPrinted);
    const index::RecursiveSet set(kEpsilon);
    rows.push_back({fixed(cell_length_m, 3), paper_on_peak(cell_length_m), fixed(usual, 5),
                    std::to_string(set.quantise(usual, Quantisation::kBlurring)), fixed(printed, 5),
                    std::to_string(set.quantise(printed, Quantisation::kBlurring))});
  }
  body.table({"cell, m", "largest ISM, paper", "ours", "index", "by 4.1 as printed", "index"},
             rows);
}

std::vector<Claim> claims_on_peaks() {
  const double long_cell = peak_of(0.5, Exponent::kHalved);
  const double short_cell = peak_of(0.025, Exponent::kHalved);
  return {
      {.place = "figure 4.6b",
       .what = "largest ISM with cells of 5 sigma",
       .paper = paper_on_peak(0.5),
       .ours = fixed(long_cell, 5),
       .verdict = long_cell > 0.99 ? Verdict::kEquals : Verdict::kFallsShort,
       .reason = long_cell > 0.99 ? "" : "see the section"},
      {.place = "figure 4.6d",
       .what = "largest ISM with cells of sigma / 4",
       .paper = paper_on_peak(0.025),
       .ours = fixed(short_cell, 5),
       .verdict = short_cell > 0.5 ? Verdict::kDeparts : Verdict::kEquals,
       .reason = "by Theorem 6 every cell from k on is above 1/2; its index is 0 all the same"}};
}

void describe_short_cells(Markdown& body) {
  const double shortest_m = kCellLengthsM.back();
  body.paragraph(
      "With cells of a quarter of sigma the thesis says that the maximum does not even "
      "overtake 1/2. It does, by " +
      scientific(peak_of(shortest_m, Exponent::kHalved) - 0.5, 1) +
      ", and with equation 4.1 as printed by " +
      scientific(peak_of(shortest_m, Exponent::kAsPrinted) - 0.5, 1) +
      ". It always does: by Theorem 6, P(o_i|z) - 1/2 is p(z|d_i) 2^-i less the sum of "
      "p(z|d_h) 2^-h over the cells h behind i, over alpha. Those powers add up to less than "
      "2^-i, and from k on the likelihoods fall, so that every cell from k on is above 1/2, "
      "however short. But here so little above that no plot shows it and no index does: p_1 is "
      "0.55. The thesis's conclusion stands, and a vehicle description with such cells is "
      "refused by the compiler.");
}

}  // namespace

void add_cell_lengths(const TablesInput& input, Section& section) {
  for (const Claim& claim : claims_on_peaks()) {
    section.claims.push_back(claim);
  }
  Markdown& body = section.body;
  body.subheading("Length of a cell: figure 4.6");
  body.paragraph(
      "One measurement with sigma = 0.10 m on a local grid of 50 m with cells of three "
      "lengths; z is the centre of the first cell behind 25 m. The indexes are those of "
      "blurring at epsilon = 0.05.");
  print_peaks(body);
  body.picture(draw(input, "sensor_model.svg", figure_4_6_a()),
               "The sensor model with and without the factor 1/2");
  body.picture(draw(input, "ism_by_cell_length.svg", figure_4_6_b_to_d()),
               "The ISM with cells of 0.5, 0.1 and 0.025 m");
  describe_short_cells(body);
}

}  // namespace iog::lab
