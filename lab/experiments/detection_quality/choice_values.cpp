#include "lab/experiments/detection_quality/choice_values.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "lab/experiments/detection_quality/quality_choices.hpp"
#include "tools/simulate/random.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;

constexpr std::array kSteps{-kFarSteps, -2, -1, 0, 1, 2};

// True if the cell that holds the point, which must mark, takes the index of cell k.
bool takes_its_hit(const FrameEvidence& evidence) {
  return std::any_of(evidence.cells.begin(), evidence.cells.end(),
                     [&evidence](const CellEvidence& seen) {
                       return seen.step == 0 && seen.cell == evidence.hits.front();
                     });
}

lidar::ScanPoint random_point(tools::Random& random) {
  const auto ticks = static_cast<std::int32_t>(random.below(3200)) - 1600;
  const auto range_mm = 1000 + static_cast<std::uint32_t>(random.below(48'000));
  return {.range_mm = range_mm,
          .azimuth_ticks = static_cast<std::uint16_t>(ticks < 0 ? ticks + 11'520 : ticks),
          .layer = static_cast<std::uint8_t>(random.below(4))};
}

}  // namespace

Table model_of_steps() {
  Table table("choice_model", {"step", "p"});
  const ByStep<double> model = probabilities({});
  for (const int step : kSteps) {
    table.row(step, model[slot_of(step)]);
  }
  return table;
}

Table indexes_of_steps() {
  Table table("choice_indexes", {"epsilon", "policy", "step", "index"});
  const ByStep<double> model = probabilities({});
  const auto add = [&](double epsilon, Quantisation policy, const char* name) {
    const ByStep<std::int32_t> values = indexes(model, epsilon, policy);
    for (const int step : kSteps) {
      table.row(epsilon, name, step, values[slot_of(step)]);
    }
  };
  for (const double epsilon : kSweep) {
    add(epsilon, Quantisation::kBlurring, "blurring");
    if (epsilon == kDefaultEpsilon) {
      add(epsilon, Quantisation::kNearest, "nearest");
    }
  }
  return table;
}

Table recursive_sets_of_sweep() {
  Table table("choice_sets", {"epsilon", "p_1", "p_minus_127"});
  for (const double epsilon : kSweep) {
    const index::RecursiveSet set(epsilon);
    table.row(epsilon, set.probability(1), set.probability(-kInt8Limit));
  }
  return table;
}

Table displaced_hits(const tools::CatalogueEntry& car, std::uint64_t seed) {
  constexpr int kPoints = 20'000;
  constexpr std::uint64_t kStream = 77;
  Table table("choice_displaced_hits", {"sampling", "points", "hits", "displaced_hits"});
  for (const auto& [sampling, name] :
       {std::pair(Sampling::kModel, "own cell"), std::pair(Sampling::kCentre, "cell centre"),
        std::pair(Sampling::kEntry, "entry")}) {
    tools::Random random(seed, kStream);
    std::uint64_t hits = 0;
    std::uint64_t displaced = 0;
    for (int i = 0; i < kPoints; ++i) {
      const lidar::ScanPoint point = random_point(random);
      const std::size_t sensor = random.below(car.sensors.size());
      const FrameEvidence evidence =
          project(*car.vehicle, {{.sensor = sensor, .point = point}}, {.sampling = sampling});
      if (!evidence.hits.empty()) {
        ++hits;
        displaced += takes_its_hit(evidence) ? 0U : 1U;
      }
    }
    table.row(name, kPoints, hits, displaced);
  }
  return table;
}

}  // namespace iog::lab
