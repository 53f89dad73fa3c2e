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

// Contains points with low <= p <= high in both coordinates.
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

// The largest coordinate of a map, which is 84 km from the map's origin. At this distance,
// positions in the plane differ from positions on the earth by several metres. Signed differences
// of coordinates fit into 25 bits, and products of two such differences fit into 49 bits.
inline constexpr std::int32_t kMaxCoordinateCm = 1 << 23;

}  // namespace iog::map
