#include "lab/evaluation/detection.hpp"

#include <algorithm>
#include <vector>

namespace iog::lab {
namespace {

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

// Cells row by row, asked for their neighbours.
class Field {
 public:
  Field(std::span<const CellState> cells, std::size_t stride) : cells_(cells), stride_(stride) {}

  // Whether the cell or one of its eight neighbours is in that state.
  [[nodiscard]] bool has_near(std::size_t cell, CellState state) const {
    const std::size_t x = cell % stride_;
    const std::size_t y = cell / stride_;
    const std::size_t last_x = std::min(x + 1, stride_ - 1);
    const std::size_t last_y = std::min(y + 1, cells_.size() / stride_ - 1);
    for (std::size_t row = y - std::min<std::size_t>(y, 1); row <= last_y; ++row) {
      for (std::size_t column = x - std::min<std::size_t>(x, 1); column <= last_x; ++column) {
        if (cells_[row * stride_ + column] == state) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  std::span<const CellState> cells_;
  std::size_t stride_;
};

}  // namespace

double ClassScore::recall() const { return share(found, visible); }
double ClassScore::recall_near() const { return share(found_near, visible); }
double ClassScore::precision() const { return share(right, called); }
double ClassScore::precision_near() const { return share(right_near, called); }

ClassScore& ClassScore::operator+=(const ClassScore& other) {
  visible += other.visible;
  found += other.found;
  found_near += other.found_near;
  called += other.called;
  right += other.right;
  right_near += other.right_near;
  return *this;
}

Detection& Detection::operator+=(const Detection& other) {
  occupied += other.occupied;
  free += other.free;
  missed += other.missed;
  missed_near += other.missed_near;
  return *this;
}

double Detection::miss_rate() const { return share(missed, occupied.visible); }
double Detection::miss_rate_near() const { return share(missed_near, occupied.visible); }

double Detection::known_of_occupied() const {
  return share(occupied.found + missed, occupied.visible);
}
double Detection::known_of_free() const {
  return share(free.found + occupied.called - occupied.right, free.visible);
}

Detection compare(std::span<const CellState> truth, std::span<const CellState> grid,
                  std::size_t stride) {
  const Field truth_field(truth, stride);
  const Field grid_field(grid, stride);
  Detection detection;
  const auto score_of = [&detection](CellState state) -> ClassScore& {
    return state == CellState::kFree ? detection.free : detection.occupied;
  };
  for (std::size_t cell = 0; cell < truth.size(); ++cell) {
    if (truth[cell] == CellState::kUnknown) {
      continue;
    }
    const bool is_right = grid[cell] == truth[cell];
    ClassScore& visible = score_of(truth[cell]);
    ++visible.visible;
    visible.found += is_right ? 1U : 0U;
    visible.found_near += is_right || grid_field.has_near(cell, truth[cell]) ? 1U : 0U;
    if (grid[cell] != CellState::kUnknown) {
      ClassScore& called = score_of(grid[cell]);
      ++called.called;
      called.right += is_right ? 1U : 0U;
      called.right_near += is_right || truth_field.has_near(cell, grid[cell]) ? 1U : 0U;
    }
    if (truth[cell] == CellState::kOccupied && grid[cell] == CellState::kFree) {
      ++detection.missed;
      detection.missed_near += grid_field.has_near(cell, CellState::kOccupied) ? 0U : 1U;
    }
  }
  return detection;
}

double EndedCells::lost() const { return share(free, all()); }
double EndedCells::left_unknown() const { return share(unknown, all()); }

EndedCells& EndedCells::operator+=(const EndedCells& other) {
  occupied += other.occupied;
  free += other.free;
  unknown += other.unknown;
  return *this;
}

EndedCells look_up(std::span<const std::uint32_t> hits, std::span<const CellState> grid) {
  std::vector<std::uint32_t> cells(hits.begin(), hits.end());
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  EndedCells ended;
  for (const std::uint32_t cell : cells) {
    ended.occupied += grid[cell] == CellState::kOccupied ? 1U : 0U;
    ended.free += grid[cell] == CellState::kFree ? 1U : 0U;
    ended.unknown += grid[cell] == CellState::kUnknown ? 1U : 0U;
  }
  return ended;
}

}  // namespace iog::lab
