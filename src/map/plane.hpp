// Points in the plane of a map, in centimetres from the map's origin. The plane is the local
// tangent plane (east, north) of WGS 84 at the origin.
#pragma once

#include <cstdint>

namespace iog::map {

struct PointCm {
  std::int32_t x = 0;  // east
  std::int32_t y = 0;  // north
  friend constexpr bool operator==(const PointCm&, const PointCm&) = default;
};

// A rectangle, including its edges. Both coordinates are lowest at the corner `low` and highest at
// the corner `high`.
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

// The maximum absolute value of a map's coordinates. At this distance from the map's origin (84
// km), positions in the plane differ from positions on the earth by several metres. Differences
// between coordinates are within +-2^24, and products of two such differences are within +-2^48.
inline constexpr std::int32_t kMaxCoordinateCm = 1 << 23;

}  // namespace iog::map
