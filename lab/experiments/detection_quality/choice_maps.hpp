// One frame's grid under several choices, as maps of letters.
#pragma once

#include <vector>

#include "lab/evaluation/cell_state.hpp"
#include "lab/evidence/projection.hpp"
#include "lab/experiments/experiment.hpp"
#include "lab/experiments/fusion_trial.hpp"

namespace iog::lab {

// A frame whose truth is known.
struct KnownFrame {
  const tools::CatalogueEntry* car = nullptr;
  FramePoints points;
  std::vector<CellState> truth;
};

// A letter for the index of a cell at the default epsilon: 'O' occupied by more than one hit, 'o'
// by one at most, '.' unknown, 'f' free by one beam at most, 'F' by more.
[[nodiscard]] char letter_of(double index);

// A square of the grid, 15 m wide, ahead of the car, with letters for its cells: a row of the table
// is one of the grid (y), a letter one of its cells (x). choice_map_rule, _epsilon, _traversal and
// _sampling have a map for each choice of the tables of these names; in choice_map_truth stands
// what is visibly occupied ('O') and free ('F'), and where beams ended ('O').
[[nodiscard]] Tables choice_maps(const KnownFrame& frame);

}  // namespace iog::lab
