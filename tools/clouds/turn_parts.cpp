#include "tools/clouds/turn_parts.hpp"

#include <algorithm>

#include "lidar/points.hpp"

namespace iog::tools {

void TurnParts::take(const std::vector<WirePoint>& points) {
  constexpr std::size_t kFewest = 8;  // directions of a cloud
  constexpr std::size_t kOfMany = 4;
  std::bitset<kDirections> seen;
  for (const WirePoint& point : points) {
    seen.set(static_cast<std::size_t>(point.first) * kDirections /
             lidar::PointsPacket::kPartsPerTurn);
  }
  const std::size_t fewer = std::min(seen.count(), before_.count());
  parts_ += fewer >= kFewest && kOfMany * (seen & before_).count() <= fewer ? 1U : 0U;
  before_ = seen;
}

}  // namespace iog::tools
