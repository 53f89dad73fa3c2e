// Turns the lowest returns of one turn into the surface that classifies the next one.
//
// In each sector a walk goes outward, bin by bin, and keeps the height and the slope of the ground
// on which it stands (docs/ground.md). A bin's lowest return is ground unless it is much higher
// than the slope predicts. A return far below the prediction is ground, too: what was taken for
// ground before it was then an object. A lowest return is also ground if it is hardly higher than
// that of the nearest sectors beside it. A bin without ground of its own takes the ground of the
// sectors beside it, if that fits. Otherwise its ground is interpolated between the nearest bins
// that have some.
//
// Each height is the median of three sectors, so a mirror image under the road is outvoted. In
// addition, the surface is nowhere in a bin more than 150 mm over the bin's lowest return. So a
// return that exceeds this by Limits::low_mm is never taken for ground, whatever else was received,
// real or forged.
//
// All sectors walk at once, eight per register. A ring holds one bin of every sector.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/bins.hpp"
#include "ground/lows.hpp"
#include "ground/surface.hpp"

namespace iog::ground {

// Maximum height of the surface over the lowest plausible return of a bin.
inline constexpr std::int32_t kMostOverLowestMm = 150;

class SurfaceWalk {
 public:
  // Ends a turn: renews the rows of sectors that had returns, and keeps the others.
  void close_turn(Bins bins, const Lows& lows, Surface& surface);

 private:
  using Ring = Lows::Ring;

  void begin();
  void expect(Bins bins, std::size_t bin, const Ring& lows);
  void turn_slopes(Bins bins, std::size_t bin);
  void choose();
  void catch_up(Bins bins, std::size_t bin);
  void catch_up(Bins bins, std::size_t bin, std::size_t sector);
  void stand(std::size_t bin);
  void go_straight_on();
  void outvote();
  void find_starts();
  void keep_low(Bins bins, const Lows& lows);
  void renew(const Lows& lows, Surface& surface) const;

  // Ground of each bin. find_starts() turns it into heights at the start of each bin and at the end
  // of the last one.
  std::array<Ring, Surface::kStarts> ground_{};
  // Where each sector's walk stands: its height, its slope in mm per bin, and its bin (-1 before
  // the first ground).
  Ring height_{};
  Ring slope_{};
  Ring last_{};
  // State of the current bin. Lows::kNothing means none.
  Ring low_{};       // lowest plausible return
  Ring expected_{};  // expected ground
  Ring most_{};      // how far above it a return is still ground
  Ring own_{};       // lowest return if it is ground by this rule
  Ring stands_{};    // whether there is any ground: all ones or zeros
  Ring found_{};     // height of that ground
};

}  // namespace iog::ground
