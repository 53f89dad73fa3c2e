// Ways to divide the fusing of a frame among cores, and what each core would have to do.
//
// The many-core paper's two (Rakotovao 2015, section III) and others. Each makes the same grid:
// sums of one sign saturate alike in any order and any grouping (docs/model.md, section 3).
//
//   cells         each core looks at all beams and carves its own rows of tiles (the paper's CBC)
//   beams, shared each core has some beams; all carve one grid, four cells at a time by compare and
//                 swap (the paper's BBB)
//   beams, own    the same, but each core carves a grid of its own
//   sensors       as above, but whoever is idle takes the next sensor
//   packets       as above, but the next packet
//   regions       whoever is idle takes the next packet and makes steps of its beams; then the next
//                 two rows of tiles, and carves the parts of all lines that lie there
//   pipeline      points to lines, carving, and the rest on a core each, frame after frame
//
// In the end the tiles in which something is known are handed out, row of tiles by row, by whoever
// is idle. There the grids of several cores are joined.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lab/experiments/fusing_work.hpp"

namespace iog::lab {

enum class Split : std::uint8_t {
  kCells,
  kBeamsShared,
  kBeamsOwn,
  kSensors,
  kPackets,
  kRegions,
  kPipeline,
};
inline constexpr std::array<std::string_view, 7> kSplitNames{
    "cells", "beams_shared", "beams_own", "sensors", "packets", "regions", "pipeline"};

// What a unit of work takes, in cycles of one core.
struct UnitCosts {
  double point = 0;         // turned to a beam
  double line = 0;          // carved, besides its blocks
  double block = 0;         // carved
  double mark = 0;          // applied
  double shared_block = 0;  // carved in a grid that others carve
  double entry = 0;         // into a line where it enters another region
  double tile = 0;          // of one grid, handed out row by row and cleared
  double joined = 0;        // tile of a further grid, added
  double round = 0;         // begun and ended
};

// Nominal, by the cost model. Those of points, lines, blocks and marks are what makes the stages
// `beams`, `carve` and `mark` of lab/data/cortex_a9.csv, four LUX, out of the counts of this
// experiment in both drives. The others are estimates, in the words of fusing_splits.cpp.
[[nodiscard]] const UnitCosts& nominal_costs();

// Sums over all cores; what is done twice counts twice.
struct Effort {
  std::uint64_t points = 0;
  std::uint64_t lines = 0;
  std::uint64_t blocks = 0;
  std::uint64_t marks = 0;
  std::uint64_t entries = 0;
  std::uint64_t tiles = 0;  // of grids, handed out
  // Cache lines of grids that one core writes and another one reads or writes in the same frame.
  std::uint64_t lines_shared = 0;
};

// Phases follow one another: a core waits for the last of the phase before. In a pipeline there is
// one, and a frame passes from core to core.
struct Division {
  Effort effort;
  std::vector<std::vector<double>> cycles;  // of each phase, by core

  [[nodiscard]] double longest() const;  // until the frame is there, rounds included
  [[nodiscard]] double busy() const;     // all cores together
};

// 1 ... 4 cores.
[[nodiscard]] Division divide(const FusingWork& work, const BlockPlane& plane, Split split,
                              std::size_t cores, const UnitCosts& costs = nominal_costs());

// Items in their order, each to the core that is idle first (of those the lowest); which core has
// which.
[[nodiscard]] std::vector<std::size_t> deal(std::span<const double> items, std::size_t cores);

}  // namespace iog::lab
