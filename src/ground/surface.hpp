// The height of the ground around a spinning sensor. Returns are classified by their height above
// this surface.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/bins.hpp"

namespace iog::ground {

class Surface {
 public:
  // The heights above the car's plane, in mm, at the start of each bin and at the end of the last
  // bin. The ground between two adjacent points is a straight line.
  static constexpr std::size_t kStarts = kBins + 1;
  using Row = std::array<std::int16_t, kStarts>;
  static constexpr std::int32_t kMost = 32'000;  // maximum magnitude of any height
  static constexpr std::size_t kNearBins = 2;

  // If a sector has no returns, its row is kept for this many consecutive turns and then reset.
  static constexpr std::uint8_t kMostTurnsKept = 10;

  // Specifies where the heights in a sector's row come from.
  enum class Source : std::uint8_t {
    kFlat,  // no returns: the car's plane
    kOwn,   // returns of the last turn
    kKept,  // returns of an earlier turn
  };

  // Converts a return's height above the car's plane to its height above the ground. Beyond the
  // last bin, the ground is extrapolated with the slope of this bin, up to kBeyondMm from the bin's
  // start.
  //
  // Ranges: the heights at two bin starts differ by at most 2^16, and `part_mm` is at most 2^14, so
  // the product of the two is at most 2^30. If |z_mm| <= 2^20, the result is below 2^21.
  [[nodiscard]] std::int32_t height_over(Bins bins, std::uint32_t sector, std::uint32_t along_mm,
                                         std::int32_t z_mm) const {
    const Place at = place_of(bins, along_mm);
    const std::int16_t* start = &rows_[sector][static_cast<std::size_t>(at.bin)];
    return z_mm - between(bins, start[0], start[1], at.part_mm);
  }

  // Returns the height of a return above the highest ground nearby. To find the highest ground
  // nearby, the height at each bin start is raised to the maximum within kNearBins bins on either
  // side.
  [[nodiscard]] std::int32_t height_over_near(Bins bins, std::uint32_t sector,
                                              std::uint32_t along_mm, std::int32_t z_mm) const {
    const Place at = place_of(bins, along_mm);
    static_assert(kNearBins == 2);
    const auto height = [&](std::int32_t start) {
      return rows_[sector][static_cast<std::size_t>(std::clamp<std::int32_t>(start, 0, kBins))];
    };
    const std::int16_t near_both =
        std::max({height(at.bin - 1), height(at.bin), height(at.bin + 1), height(at.bin + 2)});
    return z_mm - between(bins, std::max(near_both, height(at.bin - 2)),
                          std::max(near_both, height(at.bin + 3)), at.part_mm);
  }

  // Returns the lowest ground nearby. To find the lowest ground nearby, the height at each bin
  // start is lowered to the minimum within kNearBins bins on either side. Height differences due to
  // a constant slope are ignored, so evenly sloping ground is not lowered. No height is lowered
  // below the minimum within kNearBins bins.
  [[nodiscard]] Row lowest_near(std::size_t sector) const;

  [[nodiscard]] const Row& row(std::size_t sector) const { return rows_[sector]; }
  [[nodiscard]] Source source(std::size_t sector) const {
    const std::uint8_t turns = turns_kept_[sector];
    return turns == kNever ? Source::kFlat : turns == 0 ? Source::kOwn : Source::kKept;
  }
  [[nodiscard]] std::size_t count(Source source) const;

  // Returns the row of a sector that had returns in this turn. The caller rewrites this row.
  [[nodiscard]] Row& renew(std::size_t sector) {
    turns_kept_[sector] = 0;
    return rows_[sector];
  }
  // Keeps or resets the row of a sector that had no returns in this turn.
  void keep(std::size_t sector);
  // Resets all rows to the car's plane.
  void forget();

  friend bool operator==(const Surface&, const Surface&) = default;

 private:
  static constexpr std::uint32_t kBeyondMm = 16'384;
  static constexpr std::uint8_t kNever = 255;

  struct Place {
    std::int32_t bin;
    std::int32_t part_mm;
  };
  static constexpr Place place_of(Bins bins, std::uint32_t along_mm) {
    const std::uint32_t bin = bins.bin_of(along_mm);
    if (bin >= kBins) [[unlikely]] {
      const std::uint32_t begin_mm = std::uint32_t{kBins - 1} << bins.shift();
      return {kBins - 1, static_cast<std::int32_t>(std::min(along_mm - begin_mm, kBeyondMm))};
    }
    return {static_cast<std::int32_t>(bin), bins.in_bin_mm(along_mm)};
  }
  static constexpr std::int32_t between(Bins bins, std::int32_t start, std::int32_t end,
                                        std::int32_t part_mm) {
    return start + (((end - start) * part_mm) >> bins.shift());
  }

  static constexpr std::array<std::uint8_t, kSectors> none() {
    std::array<std::uint8_t, kSectors> turns{};
    turns.fill(kNever);
    return turns;
  }

  std::array<Row, kSectors> rows_{};
  std::array<std::uint8_t, kSectors> turns_kept_ = none();
};

}  // namespace iog::ground
