#include "lab/experiments/detection_quality/choice_maps.hpp"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "grid/frame_fusion.hpp"
#include "lab/experiments/detection_quality/quality_choices.hpp"

namespace iog::lab {
namespace {

// The crop: cells of the grid.
constexpr std::size_t kFirstX = 570;
constexpr std::size_t kFirstY = 437;
constexpr std::size_t kSide = 150;

// A hit is worth 2 or, in double, 2.1, a beam -14, -15 or -14.7; two of them are more than that.
constexpr double kOneHit = 2.5;
constexpr double kOneBeam = -15;

char letter_of_truth(CellState state) {
  switch (state) {
    case CellState::kFree:
      return 'F';
    case CellState::kOccupied:
      return 'O';
    case CellState::kUnknown:
      break;
  }
  return '.';
}

Table empty_map(const std::string& name) {
  return {"choice_map_" + name, {"map", "first_x_cell", "y_cell", "cells"}};
}

void add_map(const std::string& map, const std::function<char(std::size_t)>& letter_at,
             Table& table) {
  for (std::size_t y = kFirstY; y < kFirstY + kSide; ++y) {
    std::string cells;
    for (std::size_t x = kFirstX; x < kFirstX + kSide; ++x) {
      cells += letter_at(y * geometry::kCellsPerSide + x);
    }
    table.row(map, kFirstX, y, cells);
  }
}

Table maps_of(const std::string& name, const KnownFrame& frame,
              const std::vector<Choice>& choices) {
  const ByStep<double> values = probabilities(model_of(*frame.car));
  Table table = empty_map(name);
  for (const Choice& choice : choices) {
    const FrameEvidence evidence = project(*frame.car->vehicle, frame.points, choice.geometry);
    const FusedGrid grid = fuse(evidence, values, choice);
    add_map(
        choice.name, [&grid](std::size_t cell) { return letter_of(grid.index_at(cell)); }, table);
  }
  return table;
}

Table truth_of(const KnownFrame& frame) {
  std::vector<std::uint32_t> hits = project(*frame.car->vehicle, frame.points, {}).hits;
  std::sort(hits.begin(), hits.end());
  Table table = empty_map("truth");
  add_map(
      "truth", [&frame](std::size_t cell) { return letter_of_truth(frame.truth[cell]); }, table);
  add_map(
      "hits",
      [&hits](std::size_t cell) {
        return std::binary_search(hits.begin(), hits.end(), cell) ? 'O' : '.';
      },
      table);
  return table;
}

std::vector<Choice> some_quantisations() {
  std::vector<Choice> choices;
  for (const IndexFusion& fusion :
       {IndexFusion{}, IndexFusion{.policy = index::Quantisation::kNearest},
        IndexFusion{.epsilon = 0.2}, IndexFusion{.epsilon = 0.02}, IndexFusion{.epsilon = 0.005},
        IndexFusion{.epsilon = 0.001}}) {
    choices.push_back({.name = name_of(fusion), .fusion = fusion});
  }
  return choices;
}

}  // namespace

char letter_of(double index) {
  if (index > 0) {
    return index > kOneHit ? 'O' : 'o';
  }
  if (index < 0) {
    return index < kOneBeam ? 'F' : 'f';
  }
  return '.';
}

Tables choice_maps(const KnownFrame& frame) {
  return {maps_of("rule", frame, rule_choices()), maps_of("epsilon", frame, some_quantisations()),
          maps_of("traversal", frame, traversal_choices()),
          maps_of("sampling", frame, sampling_choices()), truth_of(frame)};
}

}  // namespace iog::lab
