// The lowest return in each bin during one turn of a sensor. Returns that are too low to be ground
// are ignored.
//
// A minimum does not depend on the order of its inputs or on duplicates. The lows therefore do not
// depend on the order of packets, on duplicates, or on which core processes a packet. A forged
// return can only lower the value of its bin, and never below the lowest plausible height.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/bins.hpp"

namespace iog::ground {

class Lows {
 public:
  // kNothing marks a bin without returns, and is higher than every valid return.
  static constexpr std::int16_t kNothing = 32767;
  // A ring contains one value per sector.
  using Ring = std::array<std::int16_t, kSectors>;

  Lows() { clear(); }

  void clear() {
    for (Ring& lows : rings_) {
      lows.fill(kNothing);
    }
  }

  // Adds a return. `sector` must be below kSectors, `along_mm` is the distance along the line, and
  // `z_mm` is the height above the car's plane. A return beyond the last bin is ignored.
  void add(Bins bins, std::uint32_t sector, std::uint32_t along_mm, std::int32_t z_mm) {
    const std::uint32_t bin = bins.bin_of(along_mm);
    if (bin < kBins) {
      // Only a few returns are lower than all previous returns in their bin, so the plausibility of
      // a return is checked last.
      std::int16_t& low = rings_[bin][sector];
      if (z_mm < low && z_mm >= -bins.most_plausible_mm(bin)) {
        low = static_cast<std::int16_t>(z_mm);
      }
    }
  }

  // For each bin, keeps the lower of the two values.
  void join(const Lows& other) {
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      for (std::size_t sector = 0; sector < kSectors; ++sector) {
        rings_[bin][sector] = std::min(rings_[bin][sector], other.rings_[bin][sector]);
      }
    }
  }

  [[nodiscard]] const Ring& ring(std::size_t bin) const { return rings_[bin]; }

  friend bool operator==(const Lows&, const Lows&) = default;

 private:
  std::array<Ring, kBins> rings_{};
};

}  // namespace iog::ground
