// How many borders a line has crossed after a distance, with one multiplication for each axis. A
// beam asks this for its scan point and for the beginning of each zone of its profile.
//
// Exactly. On one axis the line has crossed floor(T) borders at distance z, where
//     T = (f L + z w) / (r L),
// f is the offset of the start in its cell, w the length of the line on this axis in subcells, and
// L its whole length in millimetres. Line::through(z) computes this.
//
// Estimated. The ruler keeps two numbers, in units of 2^-32 borders,
//     base  = floor(f 2^32 / r)
//     slope = floor(w q / (r 2^e)),   q = floor(2^(32 + e) / L),
// with the q and e of LineLength, and estimates T by base + z slope. All roundings are down, so the
// estimate is never too large.
//
// How much it is too small. base lacks less than 1. slope lacks less than 1 by its own rounding,
// and less than w / (r 2^e) because q lacks less than 1. A cell is wider than 2 mm, so w / r < L /
// 2 < 2^e, and that second part is below 1, too. Altogether the estimate lacks less than 1 + 2 z,
// and with z < 2^18 that is below kSlack = 2^20.
//
// So if the fraction of the estimate is at least kSlack away from the next whole number, its
// integer part is exact. Otherwise the line itself is asked. That happens once in 2^12 distances,
// and where a distance ends on a border.
//
// Ranges. q < 2^32, w < 2^31 and f <= r; slope < 2^31, base <= 2^32, T < 2^31.
#pragma once

#include <cstdint>

#include "traversal/line.hpp"

namespace iog::traversal {

template <std::int32_t kResolution>
class AxisRuler {
  static constexpr auto kSide = static_cast<std::uint32_t>(kResolution);
  static constexpr std::uint64_t kSlack = std::uint64_t{1} << 20;

 public:
  constexpr AxisRuler(const Axis<kResolution>& axis, const LineLength& length)
      : base_((std::uint64_t{axis.offset()} << 32) / kSide),
        slope_(static_cast<std::uint32_t>(
            (std::uint64_t{axis.length()} * length.inverse() / kSide) >> length.exponent())) {}

  // Borders crossed up to and including distance_mm < 2^18. If is_exact is false it may be one too
  // few.
  struct Reading {
    std::uint32_t crossed;
    bool is_exact;
  };
  [[nodiscard]] constexpr Reading through(std::uint32_t distance_mm) const {
    const std::uint64_t estimate = base_ + std::uint64_t{distance_mm} * slope_;
    return {static_cast<std::uint32_t>(estimate >> 32),
            static_cast<std::uint32_t>(estimate) <= ~static_cast<std::uint32_t>(kSlack)};
  }

 private:
  std::uint64_t base_;
  std::uint32_t slope_;
};

// Line::through(distance, length) for one line and one length.
template <std::int32_t kResolution>
class Ruler {
 public:
  constexpr Ruler(const Line<kResolution>& line, const LineLength& length)
      : x_(line.x(), length), y_(line.y(), length) {}

  // `line` and `length` are those that the constructor was given.
  [[nodiscard]] constexpr Position through(std::uint32_t distance_mm, const Line<kResolution>& line,
                                           const LineLength& length) const {
    const auto x = x_.through(distance_mm);
    const auto y = y_.through(distance_mm);
    return x.is_exact && y.is_exact ? Position{x.crossed, y.crossed}
                                    : line.through(distance_mm, length);
  }

 private:
  AxisRuler<kResolution> x_;
  AxisRuler<kResolution> y_;
};

}  // namespace iog::traversal
