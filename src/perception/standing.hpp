// What a frame says of what stands: whether it is still there.
//
// All of it is asked of the state before the frame, tile by tile, so that no order shows.
#pragma once

#include <algorithm>
#include <cstdint>

#include "window/tile.hpp"

namespace iog::perception {

// Cells that stand and have evidence.
struct StandingCounts {
  std::uint32_t met = 0;      // something was hit within two cells
  std::uint32_t crossed = 0;  // a beam has gone through, and nothing was hit within two cells
  StandingCounts& operator+=(const StandingCounts& other) {
    met += other.met;
    crossed += other.crossed;
    return *this;
  }
  friend bool operator==(const StandingCounts&, const StandingCounts&) = default;
};

// Whether anything stands in a tile that is known, but for its outermost two columns; without it
// standing_counts() are 0.
[[nodiscard]] bool has_standing_inside(const window::Tile& tile);

// Of a tile that is known. The outermost two rows and columns are left out, because what is near
// them may be of another tile. hit, crossed: its cells in which something was hit, and those that
// beams have gone through; where ground is opened only from below (perception/opening.hpp) those
// that were low, because others go over what stands.
[[nodiscard]] StandingCounts standing_counts(const window::Tile& tile, const window::Plane& hit,
                                             const window::Plane& crossed);

// Whether beams go through what stands, all around: then the poses by which it was placed are
// wrong, whatever they say. The counts of some eight frames are held against each other, those of a
// frame half as much after five. A car that drives off is crossed, too, but walls, poles and other
// cars are met meanwhile.
//
// If the poses are wrong from the first one on, few cells come to stand, and a much larger share of
// them is crossed. So while the poses have never moved the car, fewer cells are enough if more than
// an eighth is crossed frame after frame. The excess is summed, and forgotten within some hundred
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

  // has_moved: the poses have given another place or heading than at first.
  [[nodiscard]] bool is_met(bool has_moved) const {
    const std::uint32_t all = met_ + crossed_;
    return (all >= kUnit * kFewest && crossed_ > all / kShare) ||
           (!has_moved && beyond_ > kShareBeyond * kMostBeyond);
  }

 private:
  static constexpr std::uint32_t kUnit = 16;
  static constexpr std::uint32_t kFrames = 8;
  static constexpr std::uint32_t kFewest = 500;  // cells: of fewer nothing is said
  static constexpr std::uint32_t kShare = 16;    // of all of them, which may be crossed

  static constexpr std::uint32_t kShareBeyond = 8;
  static constexpr std::uint32_t kFramesBeyond = 128;
  static constexpr std::uint32_t kMostBeyond = 80;  // cells

  std::uint32_t met_ = 0;
  std::uint32_t crossed_ = 0;
  std::uint32_t beyond_ = 0;  // in eighths of a cell
};

}  // namespace iog::perception
