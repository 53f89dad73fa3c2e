// Table 4.3 and figure 4.14 of the thesis: what a scan point says of the cells around it. Figure
// 4.6: what the length of a cell does to that.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "index/recursive_set.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/reference/inverse_sensor_model.hpp"
#include "sensor_model/profile.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;
using reference::Exponent;
using sensor_model::make_profile;
using sensor_model::Profile;

constexpr double kSigmaM = 0.10;
constexpr double kEpsilon = 0.05;
constexpr double kFloor = 0.05;
constexpr int kReachCells = 500;  // of a beam
constexpr std::array kExponents{Exponent::kHalved, Exponent::kAsPrinted};
constexpr std::array kCellLengthsM{0.5, 0.1, 0.025};  // figures 4.6b, 4.6c, 4.6d

// Equation 4.1 lacks the 1/2 in its exponent: a Gaussian of sigma / sqrt(2).
constexpr double kPrintedSigmaM = kSigmaM / 1.41421356237309504880;

constexpr Profile kBlurring = make_profile({});
constexpr Profile kNearest = make_profile({.quantisation = Quantisation::kNearest});
constexpr Profile kPrintedBlurring = make_profile({.sigma_m = kPrintedSigmaM});
constexpr Profile kPrintedNearest =
    make_profile({.sigma_m = kPrintedSigmaM, .quantisation = Quantisation::kNearest});

// What the firmware's code makes of one exponent.
struct Model {
  std::string_view exponent;
  double sigma_m;  // of the usual Gaussian that is the same
  Profile blurring;
  Profile nearest;

  [[nodiscard]] double ism(int offset) const {
    const sensor_model::SingleTarget model{.sigma_m = sigma_m, .cell_length_m = 0.10};
    return std::max(model.probability(offset), kFloor);
  }
};
constexpr std::array kModels{
    Model{"halved", kSigmaM, kBlurring, kNearest},
    Model{"as_printed", kPrintedSigmaM, kPrintedBlurring, kPrintedNearest}};

std::string_view name_of(Exponent exponent) {
  return exponent == Exponent::kHalved ? "halved" : "as_printed";
}

Table profiles_around_k() {
  Table table("profiles", {"exponent", "sigma_m", "offset_cells", "ism", "blurring_index",
                           "nearest_index", "blurring_p", "nearest_p"});
  const index::RecursiveSet set(kEpsilon);
  for (const Model& model : kModels) {
    for (int offset = -6; offset <= 5; ++offset) {
      const index::OccupancyIndex blurring = model.blurring.at(offset);
      const index::OccupancyIndex nearest = model.nearest.at(offset);
      table.row(model.exponent, model.sigma_m, offset, model.ism(offset), blurring, nearest,
                set.probability(blurring), set.probability(nearest));
    }
  }
  return table;
}

// The last offset up to which all cells have the first one's index, and the first one from which on
// all have the last one's.
Table ends_of_profiles() {
  Table table("profile_ends", {"exponent", "policy", "same_until_cells", "same_from_cells"});
  for (const Model& model : kModels) {
    for (const bool is_nearest : {false, true}) {
      const Profile& profile = is_nearest ? model.nearest : model.blurring;
      int until = -kReachCells;
      while (until < kReachCells && profile.at(until + 1) == profile.at(-kReachCells)) {
        ++until;
      }
      int from = kReachCells;
      while (from > -kReachCells && profile.at(from - 1) == profile.at(kReachCells)) {
        --from;
      }
      table.row(model.exponent, is_nearest ? "nearest" : "blurring", until, from);
    }
  }
  return table;
}

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

// Figures 4.6b to 4.6d.
Table cell_lengths() {
  Table table("cell_lengths", {"exponent", "cell_length_m", "from_z_m", "ism"});
  for (const Exponent exponent : kExponents) {
    for (const double cell_length_m : kCellLengthsM) {
      for (const CellModel& cell : models_around_z(cell_length_m, exponent)) {
        table.row(name_of(exponent), cell_length_m, cell.from_z_m, cell.ism);
      }
    }
  }
  return table;
}

Table peaks() {
  Table table("cell_length_peaks", {"exponent", "cell_length_m", "largest_ism", "blurring_index"});
  const index::RecursiveSet set(kEpsilon);
  for (const Exponent exponent : kExponents) {
    for (const double cell_length_m : kCellLengthsM) {
      double largest = 0;
      for (const CellModel& cell : models_around_z(cell_length_m, exponent)) {
        largest = std::max(largest, cell.ism);
      }
      table.row(name_of(exponent), cell_length_m, largest,
                set.quantise(largest, Quantisation::kBlurring));
    }
  }
  return table;
}

}  // namespace

Tables profiles(const Input& /*input*/) {
  return {profiles_around_k(), ends_of_profiles(), cell_lengths(), peaks()};
}

}  // namespace iog::lab
