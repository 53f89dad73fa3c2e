// How heavy a scene of the simulator is, by the one trace that the thesis leaves of its own load:
// for how many cells a node and a leaf of its quadtree stand (table 4.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "fusion/frame_fusion.hpp"
#include "index/occupancy_index.hpp"

namespace iog::lab {

// Leaves of the smallest quadtree of the grid: a block of cells is a leaf if all have the same
// index and it is not part of a larger one (thesis section 3.5.2). The second is for indexes that
// an int8 cannot hold; they are above -2^31.
[[nodiscard]] std::size_t count_leaves(
    std::span<const index::OccupancyIndex, geometry::kCellCount> cells);
[[nodiscard]] std::size_t count_leaves(std::span<const std::int32_t, geometry::kCellCount> cells);

// Means over all frames of a drive.
struct SceneLoad {
  double known_cells = 0;  // of a frame
  double cells_per_leaf = 0;
  double cells_per_node = 0;
};

// What the reference car's grids hold under rule bayes, which is nearer to the thesis's sum than
// hits_win, and the car's own profile: blurring. UsageError if there is no such scene.
[[nodiscard]] SceneLoad load_of(std::string_view scene, std::uint64_t seed, std::uint32_t seconds);

}  // namespace iog::lab
