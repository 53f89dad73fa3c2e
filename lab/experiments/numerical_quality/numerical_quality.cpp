// Table 4.6 of the thesis: what the quantisation to a recursive set costs after fusion, and where
// the differences come from.
#include <array>
#include <string_view>
#include <vector>

#include "lab/evidence/frame_points.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/experiments/numerical_quality/index_differences.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;

constexpr std::array kEpsilons{1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
constexpr const char* kCar = "reference_car";
// The drive of the tables first, then the one that is taken for the thesis's load.
constexpr std::array<std::string_view, 2> kQualityScenes{"city", "ring_road"};

// An exponent of the sensor model and its quantisations, blurring and nearest by turns.
struct Rows {
  std::string_view exponent;
  ByStep<double> model;
  std::vector<QuantisedModel> quantised;

  Rows(std::string_view of_exponent, const ModelConfig& config, std::span<const double> epsilons)
      : exponent(of_exponent), model(probabilities(config)) {
    for (const double epsilon : epsilons) {
      quantised.emplace_back(model, epsilon, Quantisation::kBlurring);
      quantised.emplace_back(model, epsilon, Quantisation::kNearest);
    }
  }
};

std::string_view name_of(Quantisation policy) {
  return policy == Quantisation::kNearest ? "nearest" : "blurring";
}

void add_differences(std::string_view scene, std::span<const Rows> all, std::uint32_t frames,
                     Table& table) {
  for (const Rows& rows : all) {
    for (const QuantisedModel& row : rows.quantised) {
      const Differences& found = row.differences;
      table.row(scene, rows.exponent, row.epsilon, name_of(row.policy), frames, found.cells,
                found.known, found.mean(), found.standard_deviation(), found.mean_of_known(),
                found.root_mean_square_of_known(), found.sum_near / found.sum, found.largest,
                found.largest_of, found.above_bound, found.largest_index);
    }
  }
}

// What quantisation does to one measurement.
Table single_measurements(std::span<const Rows> all) {
  Table table("quantised_models",
              {"exponent", "epsilon", "policy", "step", "ism", "index", "error"});
  for (const Rows& rows : all) {
    for (const QuantisedModel& row : rows.quantised) {
      for (int step = -kFarSteps; step <= kFarSteps; ++step) {
        const std::size_t slot = slot_of(step);
        table.row(rows.exponent, row.epsilon, name_of(row.policy), step, rows.model[slot],
                  row.values[slot], row.error_at(rows.model, step));
      }
    }
  }
  return table;
}

// Both exponents and their quantisations, on the frames of a drive.
std::array<Rows, 2> compared(tools::Drive& drive, const tools::CatalogueEntry& car) {
  // Equation 4.1 as printed has no 1/2 in its exponent.
  constexpr ModelConfig kPrintedModel{.sigma_m = 0.10 / 1.41421356237309504880};
  std::array rows{Rows("halved", {}, kEpsilons),
                  Rows("as_printed", kPrintedModel, std::span(kEpsilons).first(1))};
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    const FrameEvidence evidence = project(*car.vehicle, points_of(drive, frame, car));
    for (Rows& of_exponent : rows) {
      compare(evidence, of_exponent.model, of_exponent.quantised);
    }
  }
  return rows;
}

}  // namespace

Tables numerical_quality(const Input& input) {
  Table table("numerical_quality",
              {"scene", "exponent", "epsilon", "policy", "frames", "cells", "known_cells", "mean",
               "standard_deviation", "mean_of_known", "rms_of_known", "near_share", "largest",
               "largest_of_measurements", "cells_above_n_epsilon", "largest_index"});
  const tools::CatalogueEntry& car = tools::find_vehicle(kCar);
  Tables tables;
  for (const std::string_view scene : kQualityScenes) {
    tools::Drive drive(car, input.seed, input.seconds, tools::find_scene(scene));
    const std::array rows = compared(drive, car);
    add_differences(scene, rows, drive.frame_count(), table);
    if (tables.empty()) {
      tables.push_back(single_measurements(rows));
    }
  }
  tables.insert(tables.begin(), std::move(table));
  return tables;
}

}  // namespace iog::lab
