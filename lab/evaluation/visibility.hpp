// What the scanners of a car could see of a simulated world.
//
// The true occupancy covers whole solids, and nobody sees into a house. So a grid is held against
// what ideal scanners would know, found from the world alone and by no rule of fusion: each layer
// of each scanner sends beams without width or noise, 1/16 of a degree apart, through the scanner's
// field of view, and each beam goes on until the first solid, the ground or the end of the model's
// range. At 50 m two of them are 5.5 cm apart, so that no cell between them is missed.
#pragma once

#include <span>
#include <vector>

#include "lab/evaluation/cell_state.hpp"
#include "tools/simulate/world/solid.hpp"
#include "tools/simulate/world/traffic.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {

// One state per cell of the grid (y * geometry::kCellsPerSide + x):
// - visibly occupied, if a beam ends on a solid in it at a height inside the car's height band,
//   whether or not other beams pass over;
// - visibly free, if a beam crosses it inside the band, none ends in it, and no solid of the true
//   occupancy covers it (a beam over a low car says nothing of the car);
// - unknown otherwise.
// The car's scanners are ibeo LUX.
[[nodiscard]] std::vector<CellState> visibility(const tools::CatalogueEntry& car,
                                                const tools::EgoPose& ego,
                                                std::span<const tools::Solid> solids);

}  // namespace iog::lab
