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
// A share of the length is read at its distance in units of 2^-14 mm, rounded down. That lacks less
// than 2^-14 mm, so the estimate less than 2^-14 slope + 1 < 2^17 + 1 more: together still less
// than kSlack.
//
// Ranges. q < 2^32, w < 2^31 and f <= r; slope < 2^31, base <= 2^32, T < 2^31.
#pragma once

#include <cstdint>

#include "traversal/line.hpp"

namespace iog::traversal {

// A share of a line's length, at most 1, and where it lies on every line of that length.
class MeasuredShare {
 public:
  static constexpr int kFractionBits = 14;

  constexpr MeasuredShare() = default;
  // The divisor is that of the share's denominator, which is below 2^32.
  constexpr MeasuredShare(const Share& share, const numeric::Divisor& denominator,
                          const LineLength& length)
      : share_(share),
        distance_(denominator.divide(share.numerator * length.mm() << kFractionBits)) {}

  [[nodiscard]] constexpr const Share& share() const { return share_; }
  // In units of 2^-14 mm.
  [[nodiscard]] constexpr std::uint32_t distance() const { return distance_; }

 private:
  Share share_;
  std::uint32_t distance_ = 0;
};

template <std::int32_t kResolution>
class AxisRuler {
  static constexpr auto kSide = static_cast<std::uint32_t>(kResolution);
  static constexpr std::uint64_t kSlack = std::uint64_t{1} << 20;

 public:
  constexpr AxisRuler(const Axis<kResolution>& axis, const LineLength& length)
      : base_((std::uint64_t{axis.offset()} << 32) / kSide),
        slope_(static_cast<std::uint32_t>(
            (std::uint64_t{axis.length()} * length.inverse() / kSide) >> length.exponent())) {}

  // Borders crossed up to and including distance_mm < 2^18, in the upper word. If is_exact() says
  // no, it may be one too few.
  [[nodiscard]] constexpr std::uint64_t estimate(std::uint32_t distance_mm) const {
    return base_ + std::uint64_t{distance_mm} * slope_;
  }
  [[nodiscard]] constexpr std::uint64_t estimate(const MeasuredShare& share) const {
    return base_ + (std::uint64_t{share.distance()} * slope_ >> MeasuredShare::kFractionBits);
  }
  [[nodiscard]] static constexpr bool is_exact(std::uint64_t estimate) {
    return static_cast<std::uint32_t>(estimate) <= ~static_cast<std::uint32_t>(kSlack);
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
    const std::uint64_t x = x_.estimate(distance_mm);
    const std::uint64_t y = y_.estimate(distance_mm);
    if (AxisRuler<kResolution>::is_exact(x) && AxisRuler<kResolution>::is_exact(y)) [[likely]] {
      return position_of(x, y);
    }
    return line.through(distance_mm, length);
  }

  // Line::through(share) and Line::before(share). The latter is the same but on a border, where the
  // fraction is 0.
  [[nodiscard]] constexpr Position through(const MeasuredShare& share,
                                           const Line<kResolution>& line) const {
    const std::uint64_t x = x_.estimate(share);
    const std::uint64_t y = y_.estimate(share);
    if (AxisRuler<kResolution>::is_exact(x) && AxisRuler<kResolution>::is_exact(y)) [[likely]] {
      return position_of(x, y);
    }
    return line.through(share.share());
  }
  [[nodiscard]] constexpr Position before(const MeasuredShare& share,
                                          const Line<kResolution>& line) const {
    const std::uint64_t x = x_.estimate(share);
    const std::uint64_t y = y_.estimate(share);
    if (AxisRuler<kResolution>::is_exact(x - 1) && AxisRuler<kResolution>::is_exact(y - 1))
        [[likely]] {
      return position_of(x - 1, y - 1);
    }
    return line.before(share.share());
  }

 private:
  static constexpr Position position_of(std::uint64_t x, std::uint64_t y) {
    return {static_cast<std::uint32_t>(x >> 32), static_cast<std::uint32_t>(y >> 32)};
  }

  AxisRuler<kResolution> x_;
  AxisRuler<kResolution> y_;
};

}  // namespace iog::traversal
