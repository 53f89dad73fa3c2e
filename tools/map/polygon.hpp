// Polygons in the plane of a map, before they are rounded.
#pragma once

#include <vector>

#include "map/block.hpp"

namespace iog::tools {

// East and north of the origin, in centimetres.
struct PlanePoint {
  double x = 0;
  double y = 0;
};

// A ring's last point is not its first.
using Ring = std::vector<PlanePoint>;

// The inside of its rings, even-odd.
struct Polygon {
  map::Kind kind = map::Kind::kBuilding;
  std::vector<Ring> rings{};
};

// What of the ring lies in the box (Sutherland and Hodgman 1974). Where the ring leaves the box and
// comes back elsewhere, edges run there and back along the border; for the even-odd rule they
// are nothing. Empty if nothing lies in the box.
[[nodiscard]] Ring clipped(const Ring& ring, const map::BoxCm& box);

}  // namespace iog::tools
