// The grids of a simulated drive, fused by the firmware's code.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "fusion/frame_fusion.hpp"
#include "index/occupancy_index.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

// The drives of the papers' tables: a lighter load, and the thesis's.
inline constexpr std::array kDrives{"city", "ring_road"};

// A grid, row by row from the lowest y.
using GridCells = std::span<const index::OccupancyIndex, geometry::kCellCount>;

// Calls use(cells) for each frame of the reference car's drive, by this rule and the car's own
// profile. UsageError if there is no such scene.
void fuse_drive(std::string_view scene, std::uint64_t seed, std::uint32_t seconds,
                vehicle::FusionRule rule, const std::function<void(GridCells)>& use);

}  // namespace iog::lab
