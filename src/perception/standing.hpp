// Whether a frame confirms or contradicts standing cells.
//
// Uses the state before the frame, tile by tile, so the order does not matter.
#pragma once

#include <algorithm>
#include <cstdint>

#include "window/tile.hpp"

namespace iog::perception {

// Counts of standing cells with evidence.
struct StandingCounts {
  std::uint32_t met = 0;      // confirmed: a hit within two cells
  std::uint32_t crossed = 0;  // contradicted: a beam crossed it, and no hit is within two cells
  StandingCounts& operator+=(const StandingCounts& other) {
    met += other.met;
    crossed += other.crossed;
    return *this;
  }
  friend bool operator==(const StandingCounts&, const StandingCounts&) = default;
};

// Whether a known tile has a standing cell outside its two outermost columns on each side. If not,
// standing_counts() are 0.
[[nodiscard]] bool has_standing_inside(const window::Tile& tile);

// Counts a known tile. The outermost two rows and columns are left out, because cells near them may
// belong to another tile. hit, crossed: cells with hits, and cells that beams crossed. Where only
// low beams open ground (perception/opening.hpp), `crossed` counts only low beams, because others
// pass over standing objects.
[[nodiscard]] StandingCounts standing_counts(const window::Tile& tile, const window::Plane& hit,
                                             const window::Plane& crossed);

// Detects wrong poses: beams go through standing objects all around. Counts are averaged over about
// eight frames; a frame counts half after five more. A car that drives off is crossed too, but
// walls, poles and other cars are confirmed at the same time.
//
// If the poses are wrong from the start, few cells become standing, and a much larger share of them
// is crossed. So while the poses have never moved the car, fewer cells are enough if more than an
// eighth is crossed in frame after frame. The excess is summed, and decays over about a hundred
// frames.
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

  // has_moved: the pose has changed its place or heading since the first one.
  [[nodiscard]] bool is_met(bool has_moved) const {
    const std::uint32_t all = met_ + crossed_;
    return (all >= kUnit * kFewest && crossed_ > all / kShare) ||
           (!has_moved && beyond_ > kShareBeyond * kMostBeyond);
  }

 private:
  static constexpr std::uint32_t kUnit = 16;
  static constexpr std::uint32_t kFrames = 8;
  static constexpr std::uint32_t kFewest = 500;  // fewest cells for a decision
  static constexpr std::uint32_t kShare = 16;    // tolerated share of crossed cells: 1/16

  static constexpr std::uint32_t kShareBeyond = 8;
  static constexpr std::uint32_t kFramesBeyond = 128;
  static constexpr std::uint32_t kMostBeyond = 80;  // cells

  std::uint32_t met_ = 0;
  std::uint32_t crossed_ = 0;
  std::uint32_t beyond_ = 0;  // in eighths of a cell
};

}  // namespace iog::perception
