// From the lowest returns of a turn to the surface by which the next one is judged.
//
// In each sector a walk goes outward, bin by bin, and keeps the height and the slope of the ground
// that it stands on (docs/ground.md). A bin's lowest return is ground if it is not much higher than
// the slope lets expect, however much lower it is: then what was believed before was an object. It
// is ground, too, if it is hardly higher than that of the nearest sectors beside it, which know
// better. A bin without ground of its own takes that of the sectors beside it, where it fits; else
// the ground is straight from one bin that has some to the next.
//
// Of three sectors the median counts, so that a mirror image under the road is outvoted. But
// nowhere in a bin is the surface more than 150 mm over the bin's lowest return: whatever else was
// received, real or forged, a return that is so much higher than that marks.
//
// All sectors walk at the same time, eight of them in a register: a ring is a bin of every sector.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/bins.hpp"
#include "ground/lows.hpp"
#include "ground/surface.hpp"

namespace iog::ground {

// How far the surface can lie over the lowest return of a bin that is believed.
inline constexpr std::int32_t kMostOverLowestMm = 150;

class SurfaceWalk {
 public:
  // Ends a turn: renews the rows of sectors that had returns, and keeps those that had none.
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

  // The ground of each bin, in the end where it begins, and of the end of the last one.
  std::array<Ring, Surface::kStarts> ground_{};
  // Where each sector stands: its height, its slope in mm a bin, its bin or -1 before the first.
  Ring height_{};
  Ring slope_{};
  Ring last_{};
  // Of the bin at hand. The lowest returns that are believed; the ground that is expected, and how
  // far over it a return is ground at most; the lowest returns that are ground by that; whether
  // there is ground at all, as all ones or zeros, and how high it is. Lows::kNothing is none.
  Ring low_{};
  Ring expected_{};
  Ring most_{};
  Ring own_{};
  Ring stands_{};
  Ring found_{};
};

}  // namespace iog::ground
