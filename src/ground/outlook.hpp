// Computes where the beams of a sector cross a height limit above the ground.
//
// Ranges: The clearance of a beam (called `room` in the code) is the difference between its height
// and the limit. Heights are in units of 2^-14 mm, so a slope in units of 2^-24 equals the rise per
// 1,024 mm. A beam rises or falls by at most R = 2*57.3*2^24 per bin. At the start of a bin, the
// clearance is at most 64*R plus 2^17 mm, which is below 2^37. Within a bin, the ground rises or
// falls by at most 46,000 mm, so the clearance changes by at most R plus 46,000 mm, which is below
// 2^32. The divisor therefore fits in 32 bits, and the dividend is less than 2^32 times half the
// length of a bin. If a beam rises by at most 2^24 per bin (a slope of 1, or 1/2 in long bins), its
// clearance is less than 64*2^24 plus 2^16 mm, so it fits in one word.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "ground/beams.hpp"
#include "ground/bins.hpp"
#include "ground/surface.hpp"
#include "numeric/divisor.hpp"

namespace iog::ground {

// Specifies whether beams drop below a limit or rise above it.
enum class Side : std::int8_t { kBelow = 1, kAbove = -1 };

// The ground of a sector, for beams that cross a height limit in one direction. Call leave() once
// for each beam, in the order in which the beams cross the limit.
class Outlook {
 public:
  Outlook(const Beams& beams, const Surface::Row& row, std::int32_t limit_mm, Side side)
      : row_(&row),
        bins_(beams.bins()),
        sign_(static_cast<int>(side)),
        most_(beams.range_mm() / 2),
        start_mm_(beams.origin_mm() - limit_mm),
        most_of_word_(start_mm_ <= kMostStartOfWord && start_mm_ >= -kMostStartOfWord
                          ? kMostRiseOfWord / bins_.rise_of_bin(1)
                          : -1),
        is_out_(sign_ * (start_mm_ - row[0]) < 0) {}

  // Returns the distance at which a beam of this slope crosses the limit, rounded down to a
  // multiple of 2 mm. The distance is at most the line's length. The search starts in the bin in
  // which the previous beam crossed the limit.
  [[nodiscard]] std::uint32_t leave(Slope slope) {
    if (is_out_) {
      return 0;
    }
    const std::int32_t signed_slope = sign_ * slope;
    if (signed_slope <= most_of_word_ && signed_slope >= -most_of_word_) {
      return leave_by(signed_slope * bins_.rise_of_bin(1));
    }
    return leave_by(std::int64_t{signed_slope} * bins_.rise_of_bin(1));
  }

 private:
  static constexpr int kRoomBits = kSlopeFractionBits - 10;
  static constexpr std::int32_t kMostRiseOfWord = 1 << 24;
  static constexpr std::int32_t kMostStartOfWord = 32'767;

  // Returns the clearance at the start of a bin. If the clearance is negative, the beam has crossed
  // the limit.
  template <typename Word>
  [[nodiscard]] Word room(std::size_t bin, Word rise) const {
    const std::int32_t mm = sign_ * (start_mm_ - (*row_)[bin]);
    return Word{mm} * (Word{1} << kRoomBits) + rise * static_cast<Word>(bin);
  }

  template <typename Word>
  [[nodiscard]] std::uint32_t leave_by(Word rise) {
    Word behind = 0;
    while (bin_ < kBins && (behind = room(bin_ + 1, rise)) >= 0) {
      ++bin_;
    }
    if (bin_ == kBins) {
      return most_;
    }
    const Word before = room(bin_, rise);
    const std::uint32_t lost =
        static_cast<std::uint32_t>(before) - static_cast<std::uint32_t>(behind);
    const std::uint32_t half_bin = bins_.length_mm() / 2;
    const std::uint64_t share = static_cast<std::uint64_t>(before) * half_bin;
    const auto bin = static_cast<std::uint32_t>(bin_);
    return std::min(bin * half_bin + numeric::Divisor(lost).divide(share), most_);
  }

  const Surface::Row* row_;
  Bins bins_;
  int sign_;
  std::uint32_t most_;
  std::int32_t start_mm_;
  Slope most_of_word_;  // maximum slope, up or down, for which the room fits in one word
  bool is_out_;         // beams start beyond the limit
  std::size_t bin_ = 0;
};

}  // namespace iog::ground
