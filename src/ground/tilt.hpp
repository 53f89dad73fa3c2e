// Estimates from one packet how far the car has tilted and risen since the last turn. Both values
// are relative to the surface from the last turn.
//
// Braking and bumps tilt the car by up to one degree per turn of the lidar. At a distance of 20 m,
// this tilt shifts heights by 0.35 m. A straight line is therefore fitted to those returns of the
// packet that are near the sensor and near the ground. The line gives the height above the surface
// as a function of distance. A packet covers a narrow sector, in which pitch and roll appear as a
// single slope. The result depends only on the returns of the packet and on the surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::ground {

struct Tilt {
  std::int32_t up_mm = 0;  // lift; magnitude at most 100
  std::int32_t slope = 0;  // in units of 2^-14; magnitude at most 656 (2.3 degrees)

  // Returns the height error that the tilt causes at the distance `along_mm`. If along_mm <= 2^20,
  // the products stay below 2^30.
  [[nodiscard]] constexpr std::int32_t at(std::uint32_t along_mm) const {
    return up_mm + ((slope * static_cast<std::int32_t>(along_mm)) >> 14);
  }
  friend constexpr bool operator==(const Tilt&, const Tilt&) = default;
};

// A return at a distance of at least kFirstSampleMm and less than kEndOfSamplesMm.
struct Sample {
  std::uint16_t along_16_mm = 0;  // distance in units of 16 mm, rounded down
  std::int16_t height_mm = 0;     // height above the surface

  [[nodiscard]] constexpr std::uint32_t along_mm() const { return along_16_mm * 16U; }
};
inline constexpr std::uint32_t kFirstSampleMm = 3'000;
inline constexpr std::uint32_t kEndOfSamplesMm = 30'000;

// The samples of one packet. Any samples beyond the first kMost are ignored.
class Samples {
 public:
  static constexpr std::size_t kMost = 128;

  // `height_mm` is the height above the surface. Returns that are too near or too far away for a
  // Sample are ignored.
  void add(std::uint32_t along_mm, std::int32_t height_mm);
  [[nodiscard]] std::span<const Sample> all() const { return std::span(samples_).first(count_); }

 private:
  std::array<Sample, kMost> samples_;
  std::size_t count_ = 0;
};

// Fits a straight line to the samples, and returns its tilt. If the line does not fit clearly
// better than zero tilt, the result is zero. The result is also zero if fewer than `fewest` samples
// lie near the line, or if these samples are too close together. Requires fewest > 0.
[[nodiscard]] Tilt tilt_of(std::span<const Sample> samples, std::int32_t fewest);

}  // namespace iog::ground
