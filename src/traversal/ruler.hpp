// Counts the borders that a line has crossed up to a given distance, using one multiplication per
// axis. These counts are needed for the scan point of a beam and for the start of each zone of its
// profile.
//
// Exact result: At distance z, the line has crossed floor(T) borders on one axis, where
//     T = (f * L + z * w) / (r * L),
// f is the offset of the start in its cell, w is the length of the line on this axis in subcells,
// and L is the total length of the line in millimetres. Line::through(z) computes this result.
//
// Estimate: The ruler estimates T as base + z * slope, in units of 2^-32 borders, where
//     base  = floor(f * 2^32 / r), but at most 2^32 - 1
//     slope = floor(w * q / (r * 2^e)),   q = floor(2^(32 + e) / L).
// Here, q and e are the inverse and the exponent of LineLength. All values are rounded down, so the
// estimate is never too large.
//
// Error: `base` is too small by at most 1. The error of `slope` has two parts. Rounding `slope`
// itself contributes less than 1, and rounding q contributes less than w / (r * 2^e). A cell is
// wider than 2 mm, so w / r < L / 2 < 2^e, and the second part is below 1 as well. In total, the
// estimate is too small by at most 1 + 2 * z. For z < 2^18, the error of the estimate is below
// kSlack = 2^20.
//
// The integer part of the estimate is therefore exact if the estimate is at least kSlack below the
// next integer. Otherwise, Line::through() computes the result. Line::through() is needed about
// once per 2^12 distances, and whenever a distance ends on a border.
//
// MeasuredShare converts a fraction of the length to a distance in units of 2^-14 mm, rounded down.
// Only the upper word of the product of this distance and `slope` is used, so the result for each
// axis is in units of 2^-14 borders. The distance is too small by less than 2^-14 mm, which is less
// than 2^-14 borders. `base` and the product are each too small by at most one unit. `slope` is too
// small by less than 2 units of 2^-32 borders per millimetre. Over the entire distance, this error
// accumulates to less than 2^19 units of 2^-32 borders, or 2 units of 2^-14 borders. The sum of all
// errors is below kShareSlack = 5 units.
//
// Ranges: q < 2^32, w < 2^31, f <= r, slope < 2^31. A line shorter than 2^18 mm crosses fewer than
// 2^17 borders on each axis.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "numeric/divisor.hpp"
#include "traversal/line.hpp"

namespace iog::traversal {

// A fraction (at most 1) of a line's length, and the corresponding distance along a line of this
// length.
class MeasuredShare {
 public:
  static constexpr int kFractionBits = 14;

  constexpr MeasuredShare() = default;
  // `denominator` is the fraction's denominator as a precomputed divisor. It must be below 2^32.
  constexpr MeasuredShare(const Share& share, const numeric::Divisor& denominator,
                          const LineLength& length)
      : share_(share),
        distance_(denominator.divide(share.numerator * length.mm() << kFractionBits)) {}

  [[nodiscard]] constexpr const Share& share() const { return share_; }
  // Returns the distance in units of 2^-14 mm.
  [[nodiscard]] constexpr std::uint32_t distance() const { return distance_; }

 private:
  Share share_;
  std::uint32_t distance_ = 0;
};

template <std::int32_t kResolution>
class AxisRuler {
  static constexpr auto kSide = static_cast<std::uint32_t>(kResolution);
  static constexpr std::uint64_t kSlack = std::uint64_t{1} << 20;
  static constexpr std::uint32_t kShareSlack = 5;
  static constexpr std::uint32_t kShareFraction =
      (std::uint32_t{1} << MeasuredShare::kFractionBits) - 1;

 public:
  constexpr AxisRuler(const Axis<kResolution>& axis, const LineLength& length)
      : base_(static_cast<std::uint32_t>(
            std::min((std::uint64_t{axis.offset()} << 32) / kSide, kMostBase))),
        slope_(static_cast<std::uint32_t>(
            (std::uint64_t{axis.length()} * length.inverse() / kSide) >> length.exponent())) {}

  // Estimates the number of borders crossed up to and including distance_mm (< 2^18). The integer
  // part of the number is in the upper word. If is_exact() is false, the number may be too small by
  // one.
  [[nodiscard]] constexpr std::uint64_t estimate(std::uint32_t distance_mm) const {
    return base_ + std::uint64_t{distance_mm} * slope_;
  }
  [[nodiscard]] static constexpr bool is_exact(std::uint64_t estimate) {
    return static_cast<std::uint32_t>(estimate) <= ~static_cast<std::uint32_t>(kSlack);
  }

  // Estimates the number of borders crossed up to and including a fraction of the line, in units of
  // 2^-14 borders.
  [[nodiscard]] constexpr std::uint32_t estimate(const MeasuredShare& share) const {
    const std::uint64_t product = std::uint64_t{share.distance()} * slope_;
    return (base_ >> (32 - MeasuredShare::kFractionBits)) +
           static_cast<std::uint32_t>(product >> 32);
  }
  [[nodiscard]] static constexpr bool is_exact_share(std::uint32_t estimate) {
    return (estimate & kShareFraction) <= kShareFraction - kShareSlack;
  }

 private:
  static constexpr std::uint64_t kMostBase = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t base_;
  std::uint32_t slope_;
};

// Computes Line::through(distance, length) for one line and one length.
template <std::int32_t kResolution>
class Ruler {
 public:
  constexpr Ruler(const Line<kResolution>& line, const LineLength& length)
      : x_(line.x(), length), y_(line.y(), length) {}

  // `line` and `length` must be those passed to the constructor.
  [[nodiscard]] constexpr Position through(std::uint32_t distance_mm, const Line<kResolution>& line,
                                           const LineLength& length) const {
    const std::uint64_t x = x_.estimate(distance_mm);
    const std::uint64_t y = y_.estimate(distance_mm);
    if (AxisRuler<kResolution>::is_exact(x) && AxisRuler<kResolution>::is_exact(y)) [[likely]] {
      return position_of(x, y);
    }
    return line.through(distance_mm, length);
  }

  // Computes Line::through(share) and Line::before(share). The two results differ only on a border,
  // where the fractional part is 0.
  [[nodiscard]] constexpr Position through(const MeasuredShare& share,
                                           const Line<kResolution>& line) const {
    const Position at = read(share, 0);
    return at == kNotExact ? line.through(share.share()) : at;
  }
  [[nodiscard]] constexpr Position before(const MeasuredShare& share,
                                          const Line<kResolution>& line) const {
    const Position at = read(share, 1);
    return at == kNotExact ? line.before(share.share()) : at;
  }

 private:
  static constexpr Position kNotExact{~std::uint32_t{0}, 0};

  // Subtracts `before` units from the two estimates and returns their integer parts, or kNotExact
  // if an estimate may be wrong.
  [[nodiscard]] constexpr Position read(const MeasuredShare& share, std::uint32_t before) const {
    const std::uint32_t x = x_.estimate(share) - before;
    const std::uint32_t y = y_.estimate(share) - before;
    if (AxisRuler<kResolution>::is_exact_share(x) && AxisRuler<kResolution>::is_exact_share(y))
        [[likely]] {
      return {x >> MeasuredShare::kFractionBits, y >> MeasuredShare::kFractionBits};
    }
    return kNotExact;
  }

  static constexpr Position position_of(std::uint64_t x, std::uint64_t y) {
    return {static_cast<std::uint32_t>(x >> 32), static_cast<std::uint32_t>(y >> 32)};
  }

  AxisRuler<kResolution> x_;
  AxisRuler<kResolution> y_;
};

}  // namespace iog::traversal
