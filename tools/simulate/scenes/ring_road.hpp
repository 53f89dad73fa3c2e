// The simulated ring road: two carriageways of three lanes between noise barriers, banks and open
// land, driven at 25 m/s in the slow lane with few others near.
//
// It is the heavy load of the benchmarks, matched to the one trace that the thesis leaves of its
// own: table 4.7 has 3.75 cells per leaf and 2.8 per node of its quadtree. The spacing of the
// traffic and the land beside the road were chosen to that end. Little stands near, many beams that
// find something find it beyond the 50 m of the model and carve all the way, and many find nothing:
// with the reference car about 0.7 million cell updates a frame, which the thesis does not count.
#pragma once

#include <cstdint>

#include "tools/simulate/world/scene.hpp"

namespace iog::tools {

[[nodiscard]] Scene make_ring_road(std::uint64_t seed, double drive_s);

}  // namespace iog::tools
