// Where things are that move, so that a cell is asked for those alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/plane.hpp"
#include "objects/rules.hpp"
#include "objects/track.hpp"

namespace iog::objects {

class MovingBoxes {
 public:
  // Takes the boxes of tracks that move in place of those before.
  void list(std::span<const Track> tracks) {
    count_ = 0;
    for (const Track& track : tracks) {
      if (track.moves()) {
        boxes_[count_] = track.box();
        bounds_[count_++] = bounds_of(track.box());
      }
    }
  }
  void clear() { count_ = 0; }

  // Whether a point is at most kTailMm out of one of them.
  [[nodiscard]] bool hold(Point point) const {
    const Bounds its{.low = point, .high = point};
    for (std::size_t i = 0; i < count_; ++i) {
      if (bounds_[i].is_near(its, kReachMm) && boxes_[i].outside(point) <= kTailMm) {
        return true;
      }
    }
    return false;
  }

 private:
  // Along both sides of a box, so 3/2 of it along the axes of the world are enough.
  static constexpr std::int32_t kReachMm = kTailMm * 3 / 2;

  std::size_t count_ = 0;
  std::array<Bounds, kMostTracks> bounds_{};
  std::array<Box, kMostTracks> boxes_{};
};

}  // namespace iog::objects
