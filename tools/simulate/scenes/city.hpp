// The simulated city: a street of two lanes between houses and parks, driven at 9 m/s among other
// cars and people on the pavement.
#pragma once

#include <cstdint>

#include "tools/simulate/world/scene.hpp"

namespace iog::tools {

[[nodiscard]] Scene make_city(std::uint64_t seed, double drive_s);

}  // namespace iog::tools
