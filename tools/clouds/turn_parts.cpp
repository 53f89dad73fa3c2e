#include "tools/clouds/turn_parts.hpp"

#include <algorithm>

#include "lidar/points.hpp"

namespace iog::tools {
namespace {

// Whether a cloud fills most of one arc, and leaves at least a quarter of a turn empty. Few returns
// of a whole turn fill no arc.
bool is_arc(const TurnParts::Directions& seen) {
  std::size_t gap = 0;
  std::size_t longest = 0;
  for (std::size_t i = 0; i < 2 * seen.size(); ++i) {  // twice around, over the seam
    gap = seen.test(i % seen.size()) ? 0 : gap + 1;
    longest = std::max(longest, std::min(gap, seen.size()));
  }
  return 4 * longest >= seen.size() && 2 * seen.count() >= seen.size() - longest;
}

}  // namespace

void TurnParts::take(const std::vector<WirePoint>& points) {
  constexpr std::size_t kFewest = 8;  // directions of a cloud
  constexpr std::size_t kOfMany = 4;
  Directions seen;
  for (const WirePoint& point : points) {
    seen.set(static_cast<std::size_t>(point.first) * kDirections /
             lidar::PointsPacket::kPartsPerTurn);
  }
  const std::size_t fewer = std::min(seen.count(), before_.count());
  const bool are_arcs = fewer >= kFewest && is_arc(seen) && is_arc(before_);
  parts_ += are_arcs && kOfMany * (seen & before_).count() <= fewer ? 1U : 0U;
  before_ = seen;
}

}  // namespace iog::tools
