// The ground around a spinning lidar is stored in polar bins. Each turn is divided into 256 equal
// sectors, each of which spans a whole number of azimuth steps (vehicle::AzimuthSteps). Each line
// of the sensor has 64 bins (docs/model.md section 5). A bin is 1,024 mm long, or 2,048 mm if the
// line is longer than 65,536 mm.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace iog::ground {

inline constexpr std::size_t kSectors = 256;
inline constexpr std::size_t kBins = 64;

// The bin layout of one sensor.
class Bins {
 public:
  constexpr Bins() = default;
  // `range_mm` is the length of the sensor's lines, at most 2^17 mm.
  explicit constexpr Bins(std::uint32_t range_mm)
      : shift_(range_mm > kBins << kShortShift ? kShortShift + 1 : kShortShift) {}

  // Returns the base-2 logarithm of a bin's length in mm.
  [[nodiscard]] constexpr int shift() const { return shift_; }
  [[nodiscard]] constexpr std::uint32_t length_mm() const { return std::uint32_t{1} << shift_; }
  // Returns the bin at a given distance along a line. The result is kBins or more if the distance
  // is beyond the last bin.
  [[nodiscard]] constexpr std::uint32_t bin_of(std::uint32_t along_mm) const {
    return along_mm >> shift_;
  }
  [[nodiscard]] constexpr std::int32_t in_bin_mm(std::uint32_t along_mm) const {
    return static_cast<std::int32_t>(along_mm & (length_mm() - 1));
  }
  // Converts a rise per 1,024 mm to a rise per bin.
  [[nodiscard]] constexpr std::int32_t rise_of_bin(std::int32_t per_1024_mm) const {
    return per_1024_mm << (shift_ - kShortShift);
  }
  // Returns the maximum plausible height of the ground above or below the car's plane. This limit
  // is 0.3 m plus the rise of a 12.4-degree slope up to the end of the bin, but at most 14 m.
  [[nodiscard]] constexpr std::int32_t most_plausible_mm(std::uint32_t bin) const {
    return std::min(300 + rise_of_bin(225) * static_cast<std::int32_t>(bin + 1), kMostPlausibleMm);
  }
  static constexpr std::int32_t kMostPlausibleMm = 14'000;

 private:
  static constexpr int kShortShift = 10;
  int shift_ = kShortShift;
};

}  // namespace iog::ground
