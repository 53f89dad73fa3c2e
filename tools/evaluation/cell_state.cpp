#include "tools/evaluation/cell_state.hpp"

#include <algorithm>

namespace iog::tools {
namespace {

template <typename Value>
std::vector<CellState> compared(std::span<const Value> values, Value unknown) {
  std::vector<CellState> states(values.size(), CellState::kUnknown);
  std::ranges::transform(values, states.begin(), [unknown](Value value) {
    if (value == unknown) {
      return CellState::kUnknown;
    }
    return value < unknown ? CellState::kFree : CellState::kOccupied;
  });
  return states;
}

}  // namespace

std::vector<CellState> states_of(std::span<const std::int32_t> indexes) {
  return compared(indexes, 0);
}

std::vector<CellState> states_of(std::span<const double> probabilities) {
  return compared(probabilities, 0.5);
}

}  // namespace iog::tools
