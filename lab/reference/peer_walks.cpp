#include "lab/reference/peer_walks.hpp"

#include <cstddef>
#include <utility>

#include "numeric/division.hpp"

namespace iog::lab::reference {
namespace {

// In which direction a walk goes, and along which axis it takes one cell a step.
struct Steps {
  std::int32_t count;  // of the longer axis
  std::int32_t shorter;
  Cell along;
  Cell aside;
};

Steps steps_between(Cell from, Cell to) {
  const std::int32_t width = std::abs(to.x - from.x);
  const std::int32_t height = std::abs(to.y - from.y);
  const Cell x{to.x < from.x ? -1 : 1, 0};
  const Cell y{0, to.y < from.y ? -1 : 1};
  return width >= height ? Steps{width, height, x, y} : Steps{height, width, y, x};
}

Cell sum(Cell a, Cell b) { return {a.x + b.x, a.y + b.y}; }

}  // namespace

std::vector<Cell> cells_like_nav2(Cell from, Cell to) {
  const Steps steps = steps_between(from, to);
  std::vector<Cell> cells{from};
  std::int32_t error = steps.count / 2;
  for (std::int32_t i = 0; i < steps.count; ++i) {
    error += steps.shorter;
    const bool is_aside = error >= steps.count;
    error -= is_aside ? steps.count : 0;
    const Cell next = sum(cells.back(), steps.along);
    cells.push_back(is_aside ? sum(next, steps.aside) : next);
  }
  return cells;
}

std::vector<Cell> cells_like_mrpt(Cell from, Cell to) {
  constexpr std::int32_t kOne = 1 << 9;
  const std::int32_t count = steps_between(from, to).count;
  // Of magnitudes, so that a step and its mirror image are equal.
  const auto step = [count](std::int32_t extent) {
    const std::int32_t rounded = numeric::div_nearest(std::abs(extent) * kOne, count);
    return extent < 0 ? -rounded : rounded;
  };
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(count) + 1);
  for (std::int32_t i = 0; i < count; ++i) {
    cells.push_back({from.x + numeric::div_floor(i * step(to.x - from.x), kOne),
                     from.y + numeric::div_floor(i * step(to.y - from.y), kOne)});
  }
  cells.push_back(to);
  return cells;
}

// In units of 1/2000 of a cell, where the centres of the thousandths are the odd numbers. The line
// is ordered to run to the right and mirrored to run upwards: the centres' mirror images are
// centres. At the border of a column it has risen height * (border - left) / width.
std::vector<Cell> cells_like_cartographer(CellPoint<double> start, CellPoint<double> end) {
  constexpr std::int64_t kThousandths = 1000;
  constexpr std::int64_t kCell = 2 * kThousandths;
  const auto centre = [](double cells) {
    return 2 * static_cast<std::int64_t>(std::floor(cells * kThousandths)) + 1;
  };
  if (end.x < start.x) {
    std::swap(start, end);
  }
  const bool falls = end.y < start.y;
  const std::int64_t left = centre(start.x);
  const std::int64_t right = centre(end.x);
  const std::int64_t bottom = falls ? -centre(start.y) : centre(start.y);
  const std::int64_t top = falls ? -centre(end.y) : centre(end.y);
  const std::int64_t width = right - left;

  const auto row_of = [](std::int64_t y) { return numeric::div_floor(y, kCell); };
  // The row above a border of columns, and the one below it: not the same where it is a corner.
  const auto rise = [&](std::int64_t border) {
    return bottom * width + (top - bottom) * (border - left);
  };
  const auto row_after = [&](std::int64_t border) {
    return numeric::div_floor(rise(border), kCell * width);
  };
  const auto row_before = [&](std::int64_t border) {
    return numeric::div_floor(rise(border) - 1, kCell * width);
  };

  std::vector<Cell> cells;
  const std::int64_t first = numeric::div_floor(left, kCell);
  const std::int64_t last = numeric::div_floor(right, kCell);
  for (std::int64_t column = first; column <= last; ++column) {
    const std::int64_t low = column == first ? row_of(bottom) : row_after(column * kCell);
    const std::int64_t high = column == last ? row_of(top) : row_before((column + 1) * kCell);
    for (std::int64_t row = low; row <= high; ++row) {
      cells.push_back(
          {static_cast<std::int32_t>(column), static_cast<std::int32_t>(falls ? -1 - row : row)});
    }
  }
  return cells;
}

}  // namespace iog::lab::reference
