#include "lab/reference/traversal.hpp"

namespace iog::lab::reference {
namespace {

auto append_to(std::vector<Cell>& cells) {
  return [&cells](Cell cell) { cells.push_back(cell); };
}

}  // namespace

std::vector<Cell> cells_amanatides_woo(CellPoint<double> start, CellPoint<double> end) {
  std::vector<Cell> cells;
  walk_amanatides_woo(start, end, append_to(cells));
  return cells;
}

std::vector<Cell> cells_continuous(CellPoint<double> start, CellPoint<double> end) {
  std::vector<Cell> cells;
  walk_continuous(start, end, append_to(cells));
  return cells;
}

std::vector<Cell> cells_bresenham(Cell from, Cell to) {
  std::vector<Cell> cells;
  walk_bresenham(from, to, append_to(cells));
  return cells;
}

}  // namespace iog::lab::reference
