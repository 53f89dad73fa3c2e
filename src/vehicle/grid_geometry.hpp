// The grid's shape and where the vehicle stands on it (contract sections 5 and 8).
#pragma once

#include <cstdint>

#include "traversal/line.hpp"
#include "vehicle/resolution.hpp"

namespace iog::vehicle {

inline constexpr traversal::CellArea kGridArea{kCellsPerSide, kCellsPerSide};

using BeamLine = traversal::Line<kResolution>;

// The vehicle frame's origin: the corner in the middle of the grid. Cell (x, y) of the default grid
// covers, in metres, [(x - 512) / 10, (x - 511) / 10) and the same of y.
inline constexpr std::int32_t kOriginCell = kCellsPerSide / 2;

inline constexpr double kSubcellsPerMetre = 1000.0 / kCellMm * kResolution;

}  // namespace iog::vehicle
