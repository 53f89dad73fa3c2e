// Messages with clouds and scans of each kind; the first byte says which.
#include <algorithm>
#include <string>

#include "law.hpp"
#include "lidar/points.hpp"
#include "tools/clouds/foxglove_clouds.hpp"
#include "tools/clouds/ros_clouds.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::fuzz {
namespace {

tools::SeenCloud cloud_in(std::span<const std::byte> message, unsigned kind) {
  const std::string what = "it";
  tools::TimeUnit unit = tools::TimeUnit::kFound;
  switch (kind % 5) {
    case 0:
      return tools::cloud_of_point_cloud2(message, unit, what);
    case 1:
      return tools::cloud_of_laser_scan(message, what);
    case 2:
      return tools::cloud_of_livox(message, what);
    case 3:
      return tools::cloud_of_foxglove(message, kind >= 128, unit, what);
    default:
      return tools::scan_of_foxglove(message, kind >= 128, what);
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  if (input.empty()) {
    return;
  }
  try {
    const tools::SeenCloud cloud = cloud_in(input.subspan(1), std::to_integer<unsigned>(input[0]));
    law(cloud.points.size() + cloud.not_finite + cloud.nowhere <= 1'000'000, "points are bounded");
    law(std::ranges::all_of(cloud.points,
                            [](const tools::WirePoint& point) {
                              return point.first >= 0 && point.first < 1'152'000 &&
                                     std::abs(point.second) <= 288'000 && point.third >= 0 &&
                                     point.third <= 1'048'575 && point.after_us <= 1'000'000;
                            }),
        "each point can be sent");
  } catch (const tools::UsageError&) {
    return;  // no such message
  }
}

}  // namespace iog::fuzz
