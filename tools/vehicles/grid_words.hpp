// The size of a grid in words.
#pragma once

#include <string>

#include "geometry/grid.hpp"

namespace iog::tools {

// "512 x 320 cells of 0.1 m: 51.2 m ahead, 0 m behind, 16 m left, 16 m right"
[[nodiscard]] std::string words_of_grid(const geometry::Grid& grid);

}  // namespace iog::tools
