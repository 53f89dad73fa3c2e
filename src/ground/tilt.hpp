// By how much the car has tilted and lifted since the last turn, as one packet sees it.
//
// A surface is one turn old, and brakes and bumps tilt the car by up to a degree a turn: 0.35 m at
// 20 m. So of some returns of a packet that lie near and near the ground a straight line is fitted,
// height over the surface by distance. A packet sees a narrow sector, in which pitch and roll are
// one slope. What is found depends on the packet's own returns and the surface alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::ground {

struct Tilt {
  std::int32_t up_mm = 0;  // at most 100, up or down
  std::int32_t slope = 0;  // 2^-14, at most 656, which is 2.3 degrees

  // How much higher a return at this distance seems. along_mm <= 2^20, so that products stay below
  // 2^30.
  [[nodiscard]] constexpr std::int32_t at(std::uint32_t along_mm) const {
    return up_mm + ((slope * static_cast<std::int32_t>(along_mm)) >> 14);
  }
  friend constexpr bool operator==(const Tilt&, const Tilt&) = default;
};

// Of a return whose distance is kFirstSampleMm or more and less than kEndOfSamplesMm.
struct Sample {
  std::uint16_t along_16_mm = 0;  // its distance in units of 16 mm, rounded down
  std::int16_t height_mm = 0;     // over the surface

  [[nodiscard]] constexpr std::uint32_t along_mm() const { return along_16_mm * 16U; }
};
inline constexpr std::uint32_t kFirstSampleMm = 3'000;
inline constexpr std::uint32_t kEndOfSamplesMm = 30'000;

// The samples of a packet. What is beyond its size is left out.
class Samples {
 public:
  static constexpr std::size_t kMost = 128;

  // height_mm: over the surface.
  void add(std::uint32_t along_mm, std::int32_t height_mm);
  [[nodiscard]] std::span<const Sample> all() const { return std::span(samples_).first(count_); }

 private:
  std::array<Sample, kMost> samples_;
  std::size_t count_ = 0;
};

// No tilt where fewer samples than `fewest` lie near a line, where these are too near to one
// another, or where the line is not clearly better than none. fewest > 0.
[[nodiscard]] Tilt tilt_of(std::span<const Sample> samples, std::int32_t fewest);

}  // namespace iog::ground
