// The experiment of the thesis's section 4.2.2.3: a lidar in a corner of a grid of 500 x 500 cells,
// 181 beams of 500 cells at steps of half a degree, and which of the cells that they cross a walk
// finds.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "lab/reference/traversal.hpp"

namespace iog::lab {

// Where the lidar stands, and into which corner of the plane it looks.
enum class Stand : std::uint8_t {
  kCorner,          // on the grid's south-west corner, looking north-east
  kCellCentre,      // in the centre of the south-west cell, looking north-east
  kOppositeCentre,  // in the centre of the north-east cell, looking south-west
};

// How the ends of a line come to lie on subcells.
enum class Rounding : std::uint8_t { kNearest, kDown };

// Which of the beams count.
enum class Beams : std::uint8_t {
  kAll,
  kOblique,  // not those at 0, 45 and 90 degrees, which run along borders and through corners
};

// Cells of the grid, summed over the beams.
struct Coverage {
  std::uint64_t crossed = 0;  // by the continuous traversal in double precision
  std::uint64_t found = 0;    // of these, visited
  std::uint64_t beside = 0;   // visited and not crossed

  [[nodiscard]] double share_found() const { return of_crossed(found); }
  [[nodiscard]] double share_missed() const { return of_crossed(crossed - found); }

 private:
  [[nodiscard]] double of_crossed(std::uint64_t cells) const {
    return static_cast<double>(cells) / static_cast<double>(crossed);
  }
};

using CellPoint = reference::CellPoint<double>;

// The cells that a walk visits between two points.
using CellWalk = std::function<std::vector<reference::Cell>(CellPoint start, CellPoint end)>;

[[nodiscard]] Coverage cover(const CellWalk& walk, Stand stand, Beams beams = Beams::kAll);

// The product's walk (src/traversal) with r subcells per cell.
inline constexpr std::array kResolutions{1, 2, 5, 10, 20, 50, 100, 200, 256, 500, 1000, 1024};
[[nodiscard]] CellWalk discrete_walk(int resolution, Rounding rounding);  // one of kResolutions

// The share of crossed cells that a walk between ends rounded to the nearest subcell misses if the
// rounding errors are random: a cell is missed for each corner of cells that lies between the line
// and its rounded twin, a triangle as long as the beam and as wide as the error across it. Of
// corners there is one per cell. Lidar on the corner.
[[nodiscard]] double expected_misses(int resolution, std::uint64_t crossed);

}  // namespace iog::lab
