// Defines the type of a beam's line on the grid.
#pragma once

#include "geometry/sizes.hpp"
#include "traversal/line.hpp"

namespace iog::vehicle {

using BeamLine = traversal::Line<geometry::kResolution>;

}  // namespace iog::vehicle
