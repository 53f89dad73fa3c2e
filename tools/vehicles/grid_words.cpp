#include "tools/vehicles/grid_words.hpp"

#include <sstream>

namespace iog::tools {

std::string words_of_window(window::Extent extent, std::uint16_t cell_mm) {
  const auto [columns, rows] = extent.cells();
  return std::to_string(columns) + " x " + std::to_string(rows) + " cells of " +
         std::to_string(cell_mm / 10) + " cm";
}

std::string words_of_grid(const geometry::Grid& grid) {
  const auto metres = [&grid](int cells) { return cells * grid.cell_mm / 1000.0; };
  std::ostringstream words;
  words << grid.columns << " x " << grid.rows << " cells of " << metres(1)
        << " m: " << metres(grid.columns - grid.origin_column) << " m ahead, "
        << metres(grid.origin_column) << " m behind, " << metres(grid.rows - grid.origin_row)
        << " m left, " << metres(grid.origin_row) << " m right";
  return words.str();
}

}  // namespace iog::tools
