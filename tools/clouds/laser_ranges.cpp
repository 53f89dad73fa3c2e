#include "tools/clouds/laser_ranges.hpp"

#include <cmath>
#include <numbers>

#include "lidar/points.hpp"
#include "tools/clouds/point_cloud.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {

SeenCloud cloud_of_ranges(const LaserRanges& scan, const std::string& what) {
  const std::size_t count = scan.ranges_m.size();
  if (count > kMostCloudPoints || !std::isfinite(scan.first_rad) || !std::isfinite(scan.step_rad)) {
    throw UsageError(what + ": its angles are no numbers, or it has too many ranges");
  }
  SeenCloud cloud{.time_us = scan.stamp_us};
  cloud.has_times = scan.apart_s > 0 && scan.apart_s * static_cast<double>(count) <= 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double range_m = scan.ranges_m[i];
    if (std::isnan(range_m)) {
      ++cloud.not_finite;
      continue;
    }
    if (range_m < scan.least_m || range_m <= 0) {
      ++cloud.nowhere;
      continue;
    }
    const double angle = scan.first_rad + static_cast<double>(i) * scan.step_rad;
    WirePoint& point = cloud.points.emplace_back();
    point.first = azimuth_parts(std::remainder(angle * 180 / std::numbers::pi, 360));
    const bool is_seen = range_m <= scan.most_m && range_m * 1000 < lidar::kMaxRangeMm;
    point.third = is_seen ? static_cast<std::int32_t>(std::lround(range_m * 1000)) : 0;
    point.flags = is_seen ? std::uint8_t{0} : lidar::PointsPacket::kNothing;
    if (cloud.has_times) {
      point.after_us =
          static_cast<std::uint32_t>(std::lround(static_cast<double>(i) * scan.apart_s * 1e6));
    }
  }
  return cloud;
}

}  // namespace iog::tools
