#include "lab/experiments/traversal/traversal_trial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numeric/division.hpp"
#include "numeric/elementary.hpp"
#include "traversal/walk.hpp"

namespace iog::lab {
namespace {

using reference::Cell;
using Cells = std::vector<Cell>;

constexpr std::int32_t kSide = 500;
constexpr double kReach = 500;
constexpr int kHalfDegrees = 180;  // of a right angle

// The direction of a beam, exact at 0, 45 and 90 degrees and symmetric about 45.
CellPoint direction(int half_degrees) {
  if (2 * half_degrees > kHalfDegrees) {
    const CellPoint mirrored = direction(kHalfDegrees - half_degrees);
    return {mirrored.y, mirrored.x};
  }
  if (2 * half_degrees == kHalfDegrees) {
    return {std::sqrt(0.5), std::sqrt(0.5)};
  }
  const double angle = half_degrees * numeric::kPi / 360;
  return {numeric::cos(angle), numeric::sin(angle)};
}

struct Beam {
  CellPoint start;
  CellPoint end;
};

Beam beam_of(Stand stand, int half_degrees) {
  const CellPoint towards = direction(half_degrees);
  const double reach = stand == Stand::kOppositeCentre ? -kReach : kReach;
  const double start = stand == Stand::kCorner       ? 0
                       : stand == Stand::kCellCentre ? 0.5
                                                     : kSide - 0.5;
  return {{start, start}, {start + reach * towards.x, start + reach * towards.y}};
}

bool is_in_grid(Cell cell) {
  return cell.x >= 0 && cell.x < kSide && cell.y >= 0 && cell.y < kSide;
}

// Those in the grid, as numbers in ascending order.
std::vector<std::int32_t> in_grid(const Cells& cells) {
  std::vector<std::int32_t> numbers;
  for (const Cell cell : cells) {
    if (is_in_grid(cell)) {
      numbers.push_back(cell.y * kSide + cell.x);
    }
  }
  std::ranges::sort(numbers);
  return numbers;
}

std::int32_t rounded(double subcells, Rounding rounding) {
  return static_cast<std::int32_t>(
      std::floor(rounding == Rounding::kDown ? subcells : subcells + 0.5));
}

// A walk names cells by their offset in a grid; this one is wide enough to tell them apart around
// its first cell.
constexpr std::int32_t kRowStride = 1 << 12;

Cell cell_at(std::size_t offset) {
  const auto number = static_cast<std::int32_t>(offset);
  const std::int32_t y = numeric::div_floor(number + kRowStride / 2, kRowStride);
  return {number - y * kRowStride, y};
}

template <std::int32_t kResolution>
Cells walk_subcells(Beam beam, Rounding rounding) {
  const auto subcells = [rounding](CellPoint point) {
    return geometry::SubcellPoint{rounded(point.x * kResolution, rounding),
                                  rounded(point.y * kResolution, rounding)};
  };
  const traversal::Line<kResolution> line(subcells(beam.start), subcells(beam.end));
  Cells cells;
  traversal::Walk walk(line, {}, kRowStride);
  walk.until(line.before({1, 1}).crossed() + 1,
             [&cells](std::size_t offset) { cells.push_back(cell_at(offset)); });
  return cells;
}

// The resolution is a constant of the walk's code: one instance for each.
using SubcellWalk = Cells (*)(Beam, Rounding);

template <std::size_t... kIndex>
constexpr std::array<SubcellWalk, sizeof...(kIndex)> walks_of(std::index_sequence<kIndex...>) {
  return {walk_subcells<kResolutions[kIndex]>...};
}

constexpr auto kWalks = walks_of(std::make_index_sequence<kResolutions.size()>{});

}  // namespace

Coverage cover(const CellWalk& walk, Stand stand, Beams beams) {
  Coverage coverage;
  for (int half_degrees = 0; half_degrees <= kHalfDegrees; ++half_degrees) {
    if (beams == Beams::kOblique && half_degrees % (kHalfDegrees / 2) == 0) {
      continue;
    }
    const auto [start, end] = beam_of(stand, half_degrees);
    const std::vector<std::int32_t> crossed = in_grid(reference::cells_continuous(start, end));
    const std::vector<std::int32_t> visited = in_grid(walk(start, end));
    coverage.crossed += crossed.size();
    for (const std::int32_t cell : visited) {
      const bool is_crossed = std::ranges::binary_search(crossed, cell);
      ++(is_crossed ? coverage.found : coverage.beside);
    }
  }
  return coverage;
}

CellWalk discrete_walk(int resolution, Rounding rounding) {
  const auto place = std::ranges::find(kResolutions, resolution) - kResolutions.begin();
  return [walk = kWalks.at(static_cast<std::size_t>(place)), rounding](CellPoint start,
                                                                       CellPoint end) {
    return walk({start, end}, rounding);
  };
}

// The error across a beam is a U - b V, where a and b are the larger and the smaller of |cosine|
// and |sine| and U and V are uniform within half a subcell: |a U - b V| is a / 2 + b^2 / (6 a) half
// subcells in the mean.
double expected_misses(int resolution, std::uint64_t crossed) {
  double corners = 0;
  for (int half_degrees = 0; half_degrees <= kHalfDegrees; ++half_degrees) {
    const CellPoint towards = direction(half_degrees);
    const double a = std::max(towards.x, towards.y);
    const double b = std::min(towards.x, towards.y);
    const double error = (a / 2 + b * b / (6 * a)) / (2.0 * resolution);
    corners += kReach * error / 2;
  }
  return corners / static_cast<double>(crossed);
}

}  // namespace iog::lab
