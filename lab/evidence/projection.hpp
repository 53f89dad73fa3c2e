// From scan points to what they say of the cells that the integer line crosses (docs/model.md
// section 5), with one choice left open: from which 1D cell of the local grid each of them takes
// its value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/evidence/frame_points.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

// Both are exact, in integers.
enum class Sampling : std::uint8_t {
  kModel,   // the hit's cell takes 1D cell k, those before it what they are left in, at most
            // k - 1, those behind it what they are entered in, at least k + 1
  kCentre,  // the 1D cell that the cell's centre projects to (thesis figure 4.8, as prototyped)
};

// 1D cells at least this far before the scan point's take the free index; those further than this
// behind it are not in the evidence, as nothing is known of them.
inline constexpr int kFarSteps = 12;

// What belongs to steps is kept in their order, from -kFarSteps on.
inline constexpr std::size_t kStepCount = 2 * std::size_t{kFarSteps} + 1;
[[nodiscard]] constexpr std::size_t slot_of(int step) {
  return static_cast<std::size_t>(std::ptrdiff_t{step} + kFarSteps);
}

// What one beam says of one cell.
struct CellEvidence {
  std::uint32_t cell;  // y * geometry::kCellsPerSide + x
  std::int8_t step;    // 1D cell minus k, not below -kFarSteps
};

// A frame's evidence in the order of arrival, beam after beam, each from the sensor outwards. What
// a point may not do by its fate (docs/model.md section 6) is left out: a beam that only carves has
// no steps from 0 on, a later echo none below 0.
struct FrameEvidence {
  std::vector<CellEvidence> cells;
  std::vector<std::uint32_t> hits;  // the cells in which scan points that mark lie; not unique
};

[[nodiscard]] FrameEvidence project(const vehicle::Vehicle& vehicle, const FramePoints& points,
                                    Sampling sampling = Sampling::kModel);

}  // namespace iog::lab
