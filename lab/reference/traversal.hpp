// Walks along a line over the cells of a grid, as the papers compare them: the continuous traversal
// of Amanatides and Woo (1987), that of the thesis (Algorithm 5, generalised to all directions as
// its appendix B.3 does for integers), and Bresenham's line (1965).
//
// Coordinates are in cells: cell (x, y) covers [x, x + 1) x [y, y + 1). |coordinate| < 2^29.
//
// A continuous walk visits the start's cell and then every cell whose interior the line crosses, in
// order; a line exactly through a corner steps diagonally. That is docs/model.md section 5, so that
// a difference to the integer walk is one of numbers, not of rules. Where the published loops stop
// at the end's cell, these stop after as many borders as lie between the ends: a loop that waits
// for a cell can miss it. Which border comes first is decided in Real: a line that passes a corner
// within its rounding may be led around the other side.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "geometry/cell.hpp"

namespace iog::lab::reference {

using geometry::Cell;

// A point in cells.
template <typename Real>
struct CellPoint {
  Real x = 0;
  Real y = 0;
};

// One axis of a line, folded so that it runs towards plus.
template <typename Real>
struct FoldedAxis {
  std::int32_t cell = 0;     // of the start
  std::int32_t step = 1;     // +1 or -1
  std::int32_t borders = 0;  // crossed strictly before the end
  Real to_border = 1;        // from the start to the first border; 0 only if it lies on it
  Real length = 0;           // at least 0

  FoldedAxis(Real start, Real end) : length(std::abs(end - start)) {
    const Real low = std::floor(start);
    cell = static_cast<std::int32_t>(low);
    if (end < start) {
      step = -1;
      borders = cell - static_cast<std::int32_t>(std::floor(end));
      to_border = start - low;
    } else {
      borders = std::max<std::int32_t>(static_cast<std::int32_t>(std::ceil(end)) - 1 - cell, 0);
      to_border = low + 1 - start;
    }
  }
};

// Amanatides and Woo: per axis the share of the line at which its next border is crossed, and the
// share from one border to the next. `visit` takes a Cell.
template <typename Real, typename Visit>
void walk_amanatides_woo(CellPoint<Real> start, CellPoint<Real> end, Visit&& visit) {
  const FoldedAxis<Real> x(start.x, end.x);
  const FoldedAxis<Real> y(start.y, end.y);
  const Real delta_x = 1 / x.length;  // infinite on an axis that crosses no border
  const Real delta_y = 1 / y.length;
  Real next_x = x.to_border / x.length;
  Real next_y = y.to_border / y.length;
  Cell cell{x.cell, y.cell};
  visit(cell);
  for (std::int32_t left = x.borders + y.borders; left > 0;) {
    const bool is_column = next_x <= next_y;
    const bool is_row = next_y <= next_x;
    if (is_column) {
      next_x += delta_x;
      cell.x += x.step;
      --left;
    }
    if (is_row) {
      next_y += delta_y;
      cell.y += y.step;
      --left;
    }
    visit(cell);
  }
}

// The thesis: the sign of an error term says on which side of the line the next corner lies
// (equation 4.2), and a step changes it by a constant (equation B.20).
template <typename Real, typename Visit>
void walk_continuous(CellPoint<Real> start, CellPoint<Real> end, Visit&& visit) {
  const FoldedAxis<Real> x(start.x, end.x);
  const FoldedAxis<Real> y(start.y, end.y);
  Real error = x.to_border * y.length - y.to_border * x.length;
  Cell cell{x.cell, y.cell};
  visit(cell);
  for (std::int32_t left = x.borders + y.borders; left > 0;) {
    const Real before = error;
    if (before <= 0) {
      error += y.length;
      cell.x += x.step;
      --left;
    }
    if (before >= 0) {
      error -= x.length;
      cell.y += y.step;
      --left;
    }
    visit(cell);
  }
}

// Bresenham: one cell per step of the longer axis, the nearest to the line between the centres of
// the two cells; of two equally near ones that further on. Both ends are visited.
template <typename Visit>
void walk_bresenham(Cell from, Cell to, Visit&& visit) {
  const std::int32_t width = std::abs(to.x - from.x);
  const std::int32_t height = std::abs(to.y - from.y);
  const std::int32_t longer = std::max(width, height);
  const std::int32_t shorter = std::min(width, height);
  const Cell step{to.x < from.x ? -1 : 1, to.y < from.y ? -1 : 1};
  const Cell along = width >= height ? Cell{step.x, 0} : Cell{0, step.y};
  const Cell aside = width >= height ? Cell{0, step.y} : Cell{step.x, 0};
  Cell cell = from;
  visit(cell);
  // Twice the longer axis' multiple of how far the next cell would lie beside the line, less half.
  std::int32_t error = 2 * shorter - longer;
  for (std::int32_t left = longer; left > 0; --left) {
    if (error >= 0) {
      cell = {cell.x + aside.x, cell.y + aside.y};
      error -= 2 * longer;
    }
    cell = {cell.x + along.x, cell.y + along.y};
    error += 2 * shorter;
    visit(cell);
  }
}

// The same walks as lists.
[[nodiscard]] std::vector<Cell> cells_amanatides_woo(CellPoint<double> start,
                                                     CellPoint<double> end);
[[nodiscard]] std::vector<Cell> cells_continuous(CellPoint<double> start, CellPoint<double> end);
[[nodiscard]] std::vector<Cell> cells_bresenham(Cell from, Cell to);

}  // namespace iog::lab::reference
