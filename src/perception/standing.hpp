// Determines whether a frame confirms or contradicts standing cells.
//
// Each tile is evaluated as it was before the frame, so the order of the tiles does not matter.
#pragma once

#include <algorithm>
#include <cstdint>

#include "perception/rules.hpp"
#include "window/tile.hpp"

namespace iog::perception {

// Counts the standing cells that a frame confirms and those that it contradicts.
struct StandingCounts {
  std::uint32_t met = 0;      // confirmed: a hit within 0.2 m
  std::uint32_t crossed = 0;  // contradicted: a beam crossed it, and no hit is within 0.2 m
  StandingCounts& operator+=(const StandingCounts& other) {
    met += other.met;
    crossed += other.crossed;
    return *this;
  }
  friend bool operator==(const StandingCounts&, const StandingCounts&) = default;
};

// Returns true if a known tile has a standing cell. Ignores the two outermost columns on each side.
// If has_standing_inside() returns false, all counts of standing_counts() are 0.
[[nodiscard]] bool has_standing_inside(const window::Tile& tile);

// Counts the confirmed and contradicted cells of a known tile. The outermost two rows and columns
// are ignored, because hits near them may be in another tile. `hit` contains the cells with hits,
// and `crossed` contains the cells that beams crossed. If only low beams can open a cell
// (perception/opening.hpp), `crossed` contains only the cells that low beams crossed, because other
// beams pass over standing objects.
[[nodiscard]] StandingCounts standing_counts(const window::Tile& tile, const window::Plane& hit,
                                             const window::Plane& crossed,
                                             const Around& around = {});

// Detects wrong poses. If the poses are wrong, beams appear to pass through standing objects on all
// sides. Counts are averaged over about eight frames, so the weight of a frame halves about every
// five frames. When a parked car drives off, beams also cross its cells, but walls, poles and other
// cars are confirmed at the same time.
//
// If the poses are wrong from the start, few cells are classified as standing, and beams cross a
// much larger fraction of them than with correct poses. Until the position or heading first
// changes, fewer cells are therefore enough: the poses are also contradicted if more than an eighth
// of the cells are crossed in many successive frames. The excess over an eighth is accumulated, and
// decays over about a hundred frames.
class Contradiction {
 public:
  void add(const StandingCounts& frame) {
    met_ += kUnit * frame.met - met_ / kFrames;
    crossed_ += kUnit * frame.crossed - crossed_ / kFrames;
    const std::uint32_t before =
        beyond_ - beyond_ / kFramesBeyond + (kShareBeyond - 1) * frame.crossed;
    beyond_ = before - std::min(before, frame.met);
  }
  void clear() { *this = {}; }

  // Returns true if the poses are contradicted. `has_moved` is true if the position or heading has
  // changed since the first pose. The required number of cells depends on the cell size, because
  // sensors see the edges of static objects, and larger cells mean fewer cells per edge.
  [[nodiscard]] bool is_met(bool has_moved, std::uint32_t cell_mm = geometry::kCellMm) const {
    const std::uint32_t all = met_ + crossed_;
    const auto cells = [cell_mm](std::uint32_t usual) {
      return usual * geometry::kUsualCellMm / cell_mm;
    };
    return (all >= kUnit * cells(kFewest) && crossed_ > all / kShare) ||
           (!has_moved && beyond_ > kShareBeyond * cells(kMostBeyond));
  }

 private:
  static constexpr std::uint32_t kUnit = 16;
  static constexpr std::uint32_t kFrames = 8;
  static constexpr std::uint32_t kFewest = 500;  // minimum number of cells for a decision
  static constexpr std::uint32_t kShare = 16;    // tolerated fraction of crossed cells: 1/16

  static constexpr std::uint32_t kShareBeyond = 8;
  static constexpr std::uint32_t kFramesBeyond = 128;
  static constexpr std::uint32_t kMostBeyond = 80;  // cells

  std::uint32_t met_ = 0;
  std::uint32_t crossed_ = 0;
  std::uint32_t beyond_ = 0;  // in eighths of a cell
};

}  // namespace iog::perception
