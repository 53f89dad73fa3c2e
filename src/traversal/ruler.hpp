// Distances along one line to borders crossed, with one multiplication for each axis: a beam asks
// for its scan point and for the end of each zone of its profile.
//
// On one axis Line::through(z) is floor(T) with T = (f L + z w) / (r L): f offset and w length of
// the line there, L its length in millimetres. The ruler holds, in units of 2^-32 borders,
//     base  = floor(f 2^32 / r)
//     slope = floor(w q / (r 2^e)), q = floor(2^(32 + e) / L), both of LineLength
// and estimates T by base + z slope, which is never too much. Too little it is by less than
//     1 + z (1 + w / (r 2^e)) < 1 + 2 z:
// 1 for base, 1 for slope, and q is too small by at most 1, while w / r < L / 2 < 2^e (a cell is
// wider than 2 mm). With z < 2^18 that is below kSlack = 2^20. So where the estimate's fraction is
// that far from the next whole number, its integer part is exact; elsewhere, once in 2^12 distances
// and where a distance ends on a border, the line itself is asked.
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

  // Borders crossed up to and including distance_mm < 2^18, or one less where is_exact says no.
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

  // line and length: those of the constructor.
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
