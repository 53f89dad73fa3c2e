// Defines the type that is used for the line of a beam on the grid.
#pragma once

#include "geometry/sizes.hpp"
#include "traversal/line.hpp"

namespace iog::vehicle {

using BeamLine = traversal::Line<geometry::kResolution>;

}  // namespace iog::vehicle
