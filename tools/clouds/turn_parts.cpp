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
  constexpr std::size_t kFewestPoints = 16;  // of a cloud with fewer directions
  Directions seen;
  for (const WirePoint& point : points) {
    seen.set(static_cast<std::size_t>(point.first) * kDirections /
             lidar::PointsPacket::kPartsPerTurn);
  }
  const std::size_t fewer = std::min(seen.count(), before_.count());
  const bool are_sure =
      fewer >= kFewest || std::min(points.size(), points_before_) >= kFewestPoints;
  const std::size_t in_common = (seen & before_).count();
  const bool are_apart = kOfMany * in_common <= fewer || (in_common == 1 && fewer > 1);
  parts_ += are_sure && is_arc(seen) && is_arc(before_) && are_apart ? 1U : 0U;
  before_ = seen;
  points_before_ = points.size();
}

}  // namespace iog::tools
