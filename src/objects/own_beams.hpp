// The beams from the car to the hits of a track. All places that these beams pass are now free. If
// a receding object has only just left a place, no other beams reach the place for a while.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "numeric/magnitude.hpp"
#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/rules.hpp"

namespace iog::objects {

// Places are relative to the car, in units of 16 mm. Within a window, coordinates are below 2^14,
// so products fit into 32 bits.
class OwnBeams {
 public:
  static constexpr std::size_t kMost = 48;  // if there are more hits, every n-th is used

  // `numbers` contains the indices of the track's hits.
  OwnBeams(Point car, std::span<const std::uint16_t> numbers, std::span<const FrameHit> hits)
      : car_(car) {
    const std::size_t every = (numbers.size() + kMost - 1) / kMost;
    for (std::size_t i = 0; i < numbers.size(); i += every) {
      const Point at = hits[numbers[i]].at();
      ends_[count_++] = {.at = from_car(at), .range = range_mm(car, at) / kUnitMm};
    }
  }

  // Returns true if beams that end beyond the place pass close to it on both sides. Beams that
  // graze a wall pass a place on only one side.
  [[nodiscard]] bool pass(Point place) const {
    const Point its = from_car(place);
    const std::int32_t close =
        (kBesideMm + range_mm(car_, place) / 1000 * kBeamsOfAMetre) / kUnitMm;
    bool on_left = false;
    bool on_right = false;
    for (const End& end : std::span(ends_).first(count_)) {
      const std::int32_t beside = its.x_mm * end.at.y_mm - its.y_mm * end.at.x_mm;
      const std::int32_t along = its.x_mm * end.at.x_mm + its.y_mm * end.at.y_mm;
      const bool passes = numeric::magnitude(beside) <= close * end.range && along > 0 &&
                          along < (end.range - kLeftMm / kUnitMm) * end.range;
      on_left = on_left || (passes && beside <= 0);
      on_right = on_right || (passes && beside >= 0);
    }
    return on_left && on_right;
  }

 private:
  static constexpr std::int32_t kUnitMm = 16;

  struct End {
    Point at{};
    std::int32_t range = 0;
  };

  [[nodiscard]] Point from_car(Point place) const {
    return {(place.x_mm - car_.x_mm) / kUnitMm, (place.y_mm - car_.y_mm) / kUnitMm};
  }

  Point car_;
  std::size_t count_ = 0;
  std::array<End, kMost> ends_{};
};

}  // namespace iog::objects
