#include "tools/map/polygon.hpp"

namespace iog::tools {
namespace {

// What of the ring lies on that side of a line along an axis where inside(point) >= 0; inside() is
// the distance from the line.
template <typename Inside>
Ring half(const Ring& ring, Inside&& inside) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PlanePoint& from = ring[i];
    const PlanePoint& to = ring[(i + 1) % ring.size()];
    const double at_from = inside(from);
    const double at_to = inside(to);
    if (at_from >= 0) {
      kept.push_back(from);
    }
    if ((at_from >= 0) != (at_to >= 0)) {
      const double share = at_from / (at_from - at_to);
      kept.push_back({from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share});
    }
  }
  return kept;
}

}  // namespace

Ring clipped(const Ring& ring, const map::BoxCm& box) {
  const double low_x = box.low.x;
  const double low_y = box.low.y;
  const double high_x = box.high.x;
  const double high_y = box.high.y;
  Ring kept = half(ring, [=](const PlanePoint& point) { return point.x - low_x; });
  kept = half(kept, [=](const PlanePoint& point) { return high_x - point.x; });
  kept = half(kept, [=](const PlanePoint& point) { return point.y - low_y; });
  return half(kept, [=](const PlanePoint& point) { return high_y - point.y; });
}

}  // namespace iog::tools
