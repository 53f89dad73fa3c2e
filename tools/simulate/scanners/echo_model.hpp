// What a LUX makes of a surface that its beam meets: whether an echo comes back, how far and how
// wide it is measured, how it is flagged.
#pragma once

#include "tools/formats/lux/lux_scan.hpp"
#include "tools/simulate/random.hpp"
#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

inline constexpr double kLuxFarthest = 200.0;  // metres

// strength: the share of the beam that meets the surface, 0 ... 1.
[[nodiscard]] bool comes_back(Material material, double distance, double strength, Random& random);

// Fills range, pulse width and flags; layer, angle and echo number are left alone.
void measure(Material material, double distance, double strength, Random& random, LuxPoint& point);

// Now and then a drop of rain or dirt on the window sends the first echo. True: point is such one.
[[nodiscard]] bool add_clutter(Random& random, LuxPoint& point);

}  // namespace iog::tools
