// Places in the plane of a map: the local tangent plane (east, north) of WGS 84 at its origin, in
// centimetres from there.
#pragma once

#include <cstdint>

namespace iog::map {

struct PointCm {
  std::int32_t x = 0;  // east
  std::int32_t y = 0;  // north
  friend constexpr bool operator==(const PointCm&, const PointCm&) = default;
};

// low <= p <= high, both coordinates.
struct BoxCm {
  PointCm low;
  PointCm high;

  [[nodiscard]] constexpr bool holds(PointCm point) const {
    return low.x <= point.x && point.x <= high.x && low.y <= point.y && point.y <= high.y;
  }
  [[nodiscard]] constexpr bool meets(const BoxCm& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
           other.low.y <= high.y;
  }
  friend constexpr bool operator==(const BoxCm&, const BoxCm&) = default;
};

// No coordinate of a map is farther from its origin: 84 km, where the plane is metres off the
// earth. Differences fit in 25 bits with their sign, products of two in 49.
inline constexpr std::int32_t kMaxCoordinateCm = 1 << 23;

}  // namespace iog::map
