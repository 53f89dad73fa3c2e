// How much the car has tilted and lifted since the last turn, estimated from one packet.
//
// The surface is one turn old. Braking and bumps tilt the car by up to a degree per turn, which is
// 0.35 m at 20 m. So a straight line (height over the surface against distance) is fitted to
// returns of the packet that lie near the sensor and near the ground. A packet covers a narrow
// sector, in which pitch and roll appear as one slope. The result depends only on the packet's own
// returns and on the surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::ground {

struct Tilt {
  std::int32_t up_mm = 0;  // at most 100, up or down
  std::int32_t slope = 0;  // in 2^-14, at most 656 (2.3 degrees)

  // Apparent rise of a return at this distance. along_mm <= 2^20, so products stay below 2^30.
  [[nodiscard]] constexpr std::int32_t at(std::uint32_t along_mm) const {
    return up_mm + ((slope * static_cast<std::int32_t>(along_mm)) >> 14);
  }
  friend constexpr bool operator==(const Tilt&, const Tilt&) = default;
};

// A return at a distance of at least kFirstSampleMm and less than kEndOfSamplesMm.
struct Sample {
  std::uint16_t along_16_mm = 0;  // distance in units of 16 mm, rounded down
  std::int16_t height_mm = 0;     // over the surface

  [[nodiscard]] constexpr std::uint32_t along_mm() const { return along_16_mm * 16U; }
};
inline constexpr std::uint32_t kFirstSampleMm = 3'000;
inline constexpr std::uint32_t kEndOfSamplesMm = 30'000;

// The samples of a packet. Samples beyond kMost are left out.
class Samples {
 public:
  static constexpr std::size_t kMost = 128;

  // height_mm is over the surface. Returns outside the range of a Sample are left out.
  void add(std::uint32_t along_mm, std::int32_t height_mm);
  [[nodiscard]] std::span<const Sample> all() const { return std::span(samples_).first(count_); }

 private:
  std::array<Sample, kMost> samples_;
  std::size_t count_ = 0;
};

// Fits the tilt. Returns no tilt if fewer samples than `fewest` lie near a line, if these are too
// close together, or if the line is not clearly better than no tilt. fewest > 0.
[[nodiscard]] Tilt tilt_of(std::span<const Sample> samples, std::int32_t fewest);

}  // namespace iog::ground
