// Stores the boxes of moving tracks for fast lookups by cell.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/plane.hpp"
#include "objects/rules.hpp"
#include "objects/track.hpp"

namespace iog::objects {

class MovingBoxes {
 public:
  // Replaces the stored boxes with the boxes of all moving tracks in `tracks`.
  void list(std::span<const Track> tracks) {
    count_ = 0;
    for (const Track& track : tracks) {
      if (track.moves()) {
        boxes_[count_] = track.box();
        reaches_[count_++] = bounds_of(track.box()).grown(kReachMm);
      }
    }
  }
  void clear() { count_ = 0; }

  // Returns those cells in `asked` whose centres are in a stored box or at most kTailMm outside it.
  // All cells are in one row. Bit 0 of `asked` represents the cell `first`, and bit i represents
  // the i-th cell to the right of `first`. `asked` must not be 0.
  [[nodiscard]] std::uint32_t hold(geometry::Cell first, std::uint32_t asked) const {
    const Bounds row{.low = centre_of({first.x + std::countr_zero(asked), first.y}),
                     .high = centre_of({first.x + 31 - std::countl_zero(asked), first.y})};
    std::uint32_t held = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (!reaches_[i].meets(row)) {
        continue;
      }
      for (std::uint32_t left = asked & ~held; left != 0; left &= left - 1) {
        const int x = std::countr_zero(left);
        const bool is_held = boxes_[i].outside(centre_of({first.x + x, first.y})) <= kTailMm;
        held |= (is_held ? std::uint32_t{1} : 0) << x;
      }
    }
    return held;
  }

 private:
  // A point that is kTailMm outside a box along both axes is at most 3/2 * kTailMm outside the
  // bounds of the box.
  static constexpr std::int32_t kReachMm = kTailMm * 3 / 2;

  std::size_t count_ = 0;
  std::array<Bounds, kMostTracks> reaches_{};
  std::array<Box, kMostTracks> boxes_{};
};

}  // namespace iog::objects
