#include "lab/evaluation/cell_state.hpp"

#include <algorithm>

namespace iog::lab {
namespace {

template <typename Value>
std::vector<CellState> compared(std::span<const Value> values, Value low, Value high) {
  std::vector<CellState> states(values.size(), CellState::kUnknown);
  std::transform(values.begin(), values.end(), states.begin(), [low, high](Value value) {
    if (value < low) {
      return CellState::kFree;
    }
    return value > high ? CellState::kOccupied : CellState::kUnknown;
  });
  return states;
}

}  // namespace

std::vector<CellState> states_of(std::span<const std::int32_t> indexes) {
  return compared(indexes, 0, 0);
}

std::vector<CellState> states_of(std::span<const double> probabilities, double margin) {
  return compared(probabilities, 0.5 - margin, 0.5 + margin);
}

}  // namespace iog::lab
