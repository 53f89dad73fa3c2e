// The lowest return of each bin in one turn of a sensor, of those that can be ground.
//
// A minimum does not mind the order of what it is taken of, nor how often a return comes. So any
// order of packets, packets that come twice, and packets divided among cores give the same lows.
// What is forged among the returns of a bin can only lower them, and not out of sight: what is
// lower than anybody believes is left out.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/bins.hpp"

namespace iog::ground {

class Lows {
 public:
  // Higher than any return that counts: nothing was seen.
  static constexpr std::int16_t kNothing = 32767;
  // By sector.
  using Ring = std::array<std::int16_t, kSectors>;

  Lows() { clear(); }

  void clear() {
    for (Ring& lows : rings_) {
      lows.fill(kNothing);
    }
  }

  // A return: sector < kSectors, its distance along its line, its height over the car's plane. One
  // beyond the last bin is left out.
  void add(Bins bins, std::uint32_t sector, std::uint32_t along_mm, std::int32_t z_mm) {
    const std::uint32_t bin = bins.bin_of(along_mm);
    if (bin < kBins) {
      // Few are lower than those before, so few are asked whether anybody believes them.
      std::int16_t& low = rings_[bin][sector];
      if (z_mm < low && z_mm >= -bins.most_plausible_mm(bin)) {
        low = static_cast<std::int16_t>(z_mm);
      }
    }
  }

  // The lower of both, bin by bin.
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
