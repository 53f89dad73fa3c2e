// Computes the surface from the lowest returns of one turn. This surface is used to classify the
// returns of the next turn.
//
// In each sector, a walk moves outward bin by bin and tracks the height and the slope of the ground
// (docs/ground.md). The lowest return of a bin is ground unless it is much higher than the slope
// predicts. The first ground in a sector must instead be close to the car's plane, or at most
// slightly above the surface of the previous turn, and not high above this surface in most of three
// sectors. After a first ground that is far away and high, only small height steps are accepted
// until the ground is confirmed. A lowest return far below the prediction is always accepted as
// ground, because the ground found earlier must have been an object. A lowest return that is too
// high still counts as ground if it is at most slightly above the ground in a nearby sector. A bin
// without its own ground takes the mean ground of the nearest sectors on either side, provided that
// this mean is close to the prediction. Otherwise, its ground is interpolated between the nearest
// bins with ground.
//
// To suppress mirror images below the road, each height is the median of three sectors, and a
// lowest return far below the car's plane and the lowest returns on both sides is ignored. In
// addition, the surface is at most 150 mm above the other lowest returns. A return more than `150
// mm + Limits::low_mm` above the lowest return of its bin is therefore never classified as ground,
// unless this lowest return is more than kMirroredMm below the car's plane. No other return, real
// or forged, can change this.
//
// Each register holds eight sectors, which are processed in parallel. A ring contains the same bin
// of every sector.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/bins.hpp"
#include "ground/lows.hpp"
#include "ground/surface.hpp"

namespace iog::ground {

// The maximum height of the surface above the lowest believed return of a bin.
inline constexpr std::int32_t kMostOverLowestMm = 150;
// A mirror image is more than this far below the car's plane, and below the lowest returns three
// sectors away on both sides.
inline constexpr std::int32_t kMirroredMm = 1'000;

class SurfaceWalk {
 public:
  // Ends a turn. Updates the rows of sectors that had returns, and keeps or resets the other rows.
  void close_turn(Bins bins, const Lows& lows, Surface& surface);

 private:
  using Ring = Lows::Ring;

  void begin(const Surface& surface);
  void expect(Bins bins, std::size_t bin, const Ring& lows);
  void turn_slopes(Bins bins, std::size_t bin);
  void choose();
  void catch_up(Bins bins, std::size_t bin);
  void catch_up(Bins bins, std::size_t bin, std::size_t sector);
  void doubt(std::size_t bin);
  void stand(std::size_t bin);
  void go_straight_on();
  void outvote();
  void find_starts();
  void keep_low(Bins bins, const Lows& lows);
  void renew(const Lows& lows, Surface& surface) const;

  // The ground of each bin. Until the walk reaches a bin, its entry holds the surface from the
  // previous turn. `find_starts()` converts the ground to heights at the start of each bin and at
  // the end of the last bin.
  std::array<Ring, Surface::kStarts> ground_{};
  // The current state of each sector's walk: the height of the last ground found, the slope in mm
  // per bin, and the last bin with ground. This bin is -1 until the first ground in the sector is
  // found.
  Ring height_{};
  Ring slope_{};
  Ring last_{};
  Ring doubt_{};  // own grounds that are still needed before steps may be large
  // The state of the current bin. The value Lows::kNothing means that there is no value.
  Ring low_{};       // lowest believed return
  Ring expected_{};  // expected height of the ground
  Ring most_{};      // maximum height above the expected ground at which a return is still ground
  Ring own_{};       // lowest return, if it is ground by this rule
  Ring stands_{};    // all ones if there is any ground, otherwise zero
  Ring found_{};     // height of this ground
};

}  // namespace iog::ground
