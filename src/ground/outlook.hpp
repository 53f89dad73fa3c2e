// Where the beams of a sector leave a height over the ground.
//
// Ranges. Heights are in units of 2^-14 mm, in which a slope of 2^-24 is what a beam rises in 1,024
// mm. Where a bin begins, a beam has at most 2^37 of room: 64 bins of 2^31, and 2^17 mm. Until the
// bin ends, that changes by less than 2^32: 46,000 mm of ground and 2 * 57.3 * 2^24 of slope. So a
// divisor has 32 bits, and what is divided is below 2^32 times half a bin.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "ground/beams.hpp"
#include "ground/bins.hpp"
#include "ground/surface.hpp"
#include "numeric/divisor.hpp"

namespace iog::ground {

// On which side of the limits beams leave.
enum class Side : std::int8_t { kBelow = 1, kAbove = -1 };

// A sector's ground, as beams see it that leave on one side. Each may leave no sooner than the one
// before.
class Outlook {
 public:
  Outlook(const Beams& beams, const Surface::Row& row, std::int32_t limit_mm, Side side)
      : beams_(&beams), row_(&row), limit_mm_(limit_mm), sign_(static_cast<int>(side)) {}

  // How far a beam of this slope gets, in steps of 2 mm, rounded down; at most the line's length.
  // Of the beam before, which leaves no later, it knows in which bin.
  [[nodiscard]] std::uint32_t leave(Slope slope) {
    const Bins bins = beams_->bins();
    const std::int64_t rise = std::int64_t{sign_} * slope * bins.rise_of_bin(1);
    if (room(0, rise) < 0) {
      return 0;
    }
    while (bin_ < kBins && room(bin_ + 1, rise) >= 0) {
      ++bin_;
    }
    const std::uint32_t most = beams_->range_mm() / 2;
    if (bin_ == kBins) {
      return most;
    }
    const std::int64_t before = room(bin_, rise);
    const auto lost = static_cast<std::uint32_t>(before - room(bin_ + 1, rise));
    const std::uint32_t half_bin = bins.length_mm() / 2;
    const std::uint64_t share = static_cast<std::uint64_t>(before) * half_bin;
    const auto bin = static_cast<std::uint32_t>(bin_);
    return std::min(bin * half_bin + numeric::Divisor(lost).divide(share), most);
  }

 private:
  static constexpr int kRoomBits = kSlopeFractionBits - 10;

  // Where a bin begins, between the beam and the limit; below 0 it has left.
  [[nodiscard]] std::int64_t room(std::size_t bin, std::int64_t rise) const {
    const std::int32_t mm = sign_ * (beams_->origin_mm() - (*row_)[bin] - limit_mm_);
    return (std::int64_t{mm} << kRoomBits) + rise * static_cast<std::int64_t>(bin);
  }

  const Beams* beams_;
  const Surface::Row* row_;
  std::int32_t limit_mm_;
  int sign_;
  std::size_t bin_ = 0;
};

}  // namespace iog::ground
