// The sizes of a grid and of a window in words.
#pragma once

#include <string>

#include "geometry/grid.hpp"
#include "window/area.hpp"

namespace iog::tools {

// "512 x 320 cells of 0.1 m: 51.2 m ahead, 0 m behind, 16 m left, 16 m right"
[[nodiscard]] std::string words_of_grid(const geometry::Grid& grid);
// "384 x 640 cells of 20 cm"
[[nodiscard]] std::string words_of_window(window::Extent extent, std::uint16_t cell_mm);

}  // namespace iog::tools
