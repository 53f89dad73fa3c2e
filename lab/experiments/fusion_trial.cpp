#include "lab/experiments/fusion_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "grid/frame_fusion.hpp"
#include "numeric/elementary.hpp"

namespace iog::lab {
namespace {

constexpr std::array kGeometries{
    Geometry{Path::kCrossed, Sampling::kModel},    Geometry{Path::kCrossed, Sampling::kCentre},
    Geometry{Path::kCrossed, Sampling::kEntry},    Geometry{Path::kBresenham, Sampling::kModel},
    Geometry{Path::kBresenham, Sampling::kCentre}, Geometry{Path::kBresenham, Sampling::kEntry}};

bool is_same(const Geometry& a, const Geometry& b) {
  return a.path == b.path && a.sampling == b.sampling;
}

// 1/2 +- 1e-3, as an index at the default epsilon.
constexpr double kHardlyAny = 0.02;

double log_odds_of_one(double epsilon) { return numeric::log((0.5 + epsilon) / (0.5 - epsilon)); }

}  // namespace

std::vector<CellState> FusedGrid::states() const {
  if (const auto* const indexes = std::get_if<std::vector<std::int32_t>>(&cells)) {
    return states_of(*indexes);
  }
  return states_of(std::get<std::vector<double>>(cells), kSaysNothing);
}

double FusedGrid::index_at(std::size_t cell) const {
  double log_odds = 0;
  if (const auto* const indexes = std::get_if<std::vector<std::int32_t>>(&cells)) {
    log_odds = (*indexes)[cell] * log_odds_of_one(epsilon);
  } else {
    constexpr double kCertain = 1e-12;
    const double probability =
        std::clamp(std::get<std::vector<double>>(cells)[cell], kCertain, 1 - kCertain);
    log_odds = numeric::log(probability / (1 - probability));
  }
  const double index = log_odds / log_odds_of_one(kDefaultEpsilon);
  return std::abs(index) < kHardlyAny ? 0 : index;
}

FusedGrid fuse(const FrameEvidence& evidence, const ByStep<double>& probabilities,
               const Choice& choice) {
  if (const auto* const rule = std::get_if<ProbabilityRule>(&choice.fusion)) {
    return {.cells = fuse_probabilities(evidence, probabilities, *rule)};
  }
  const auto& config = std::get<IndexFusion>(choice.fusion);
  const ByStep<std::int32_t> values = indexes(probabilities, config.epsilon, config.policy);
  return {.cells = fuse_indexes(evidence, values, config.rule, config.limit),
          .epsilon = config.epsilon};
}

ModelConfig model_of(const tools::CatalogueEntry& car) {
  const description::SensorConfig& sensor = car.sensors.front();
  return {.sigma_m = sensor.sigma_m, .cell_length_m = sensor.precision_mm / 1000.0};
}

double Trial::phantoms_per_frame() const {
  const ClassScore& occupied = detection.occupied;
  return static_cast<double>(occupied.called - occupied.right_near) / static_cast<double>(frames);
}

Trials::Trials(const tools::CatalogueEntry& car, const std::vector<Choice>& choices)
    : car_(&car), probabilities_(probabilities(model_of(car))) {
  for (const Choice& choice : choices) {
    trials_.push_back({.choice = choice, .detection = {}, .roc = {}, .ended = {}});
  }
}

void Trials::add(const FramePoints& points) { add(points, {}); }

void Trials::add(const FramePoints& points, std::span<const CellState> truth) {
  for (const Geometry& geometry : kGeometries) {
    const auto uses_it = [&](const Trial& trial) {
      return is_same(trial.choice.geometry, geometry);
    };
    if (std::ranges::none_of(trials_, uses_it)) {
      continue;
    }
    const FrameEvidence evidence = project(*car_->vehicle, points, geometry);
    for (Trial& trial : trials_) {
      if (uses_it(trial)) {
        add_to(trial, evidence, truth);
      }
    }
  }
}

void Trials::add_to(Trial& trial, const FrameEvidence& evidence,
                    std::span<const CellState> truth) const {
  const FusedGrid grid = fuse(evidence, probabilities_, trial.choice);
  const std::vector<CellState> states = grid.states();
  trial.ended += look_up(evidence.hits, states);
  ++trial.frames;
  if (!truth.empty()) {
    trial.detection += compare(truth, states, geometry::kCellsPerSide);
    std::visit([&](const auto& values) { trial.roc.add(truth, values); }, grid.cells);
  }
}

const Trial& Trials::at(const std::string& name) const {
  const auto trial = std::ranges::find(
      trials_, name, [](const Trial& each) -> const std::string& { return each.choice.name; });
  if (trial == trials_.end()) {
    throw std::out_of_range("no choice " + name);
  }
  return *trial;
}

}  // namespace iog::lab
