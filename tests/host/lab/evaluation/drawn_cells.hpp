// Cell states drawn as text, a row of the text for a row of the grid, the highest y on top:
// '#' occupied, '.' free, ' ' unknown.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lab/evaluation/cell_state.hpp"

namespace iog::lab {

// Every row of the drawing has the same length.
inline std::vector<CellState> drawn(const std::vector<std::string_view>& rows) {
  std::vector<CellState> cells;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char sign : *row) {
      cells.push_back(sign == '#'   ? CellState::kOccupied
                      : sign == '.' ? CellState::kFree
                                    : CellState::kUnknown);
    }
  }
  return cells;
}

// `width` cells of a row from `first`.
inline std::string drawing(std::span<const CellState> cells, std::size_t first, std::size_t width) {
  std::string row;
  for (const CellState cell : cells.subspan(first, width)) {
    row += cell == CellState::kOccupied ? '#' : cell == CellState::kFree ? '.' : ' ';
  }
  return row;
}

}  // namespace iog::lab
