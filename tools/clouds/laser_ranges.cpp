#include "tools/clouds/laser_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "lidar/points.hpp"
#include "tools/clouds/point_cloud.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

constexpr double kMostStepRad = 0.2;

std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

// The first thing that is wrong with the head; empty: nothing.
std::string wrong_in(const LaserRanges& scan) {
  if (!std::isfinite(scan.most_m) || scan.most_m <= 0) {
    return "range_max is " + text_of(scan.most_m) + " m";
  }
  if (!(scan.least_m <= scan.most_m)) {
    return "range_min is " + text_of(scan.least_m) + " m, and range_max " + text_of(scan.most_m);
  }
  if (!std::isfinite(scan.first_rad) || !std::isfinite(scan.last_rad)) {
    return "angle_min is " + text_of(scan.first_rad) + ", and angle_max " + text_of(scan.last_rad);
  }
  if (scan.ranges_m.size() < 2) {
    return {};
  }
  const double step = std::abs(scan.step_rad);
  if (!(step > 0 && step <= kMostStepRad)) {
    return "angle_increment is " + text_of(scan.step_rad) + " rad from beam to beam; at most " +
           text_of(kMostStepRad) + " is read";
  }
  const double end = scan.first_rad + scan.step_rad * static_cast<double>(scan.ranges_m.size() - 1);
  constexpr double kRounded = 1.01;
  if (std::abs(end - scan.first_rad) > 2 * std::numbers::pi + step) {
    return "its beams go from " + text_of(scan.first_rad) + " to " + text_of(end) +
           " rad, which is more than a turn";
  }
  return std::abs(end - scan.last_rad) <= kRounded * step
             ? std::string()
             : "by angle_min and angle_increment its last beam is at " + text_of(end) +
                   " rad, and angle_max is " + text_of(scan.last_rad);
}

}  // namespace

SeenCloud cloud_of_ranges(const LaserRanges& scan, const std::string& what) {
  const std::size_t count = scan.ranges_m.size();
  if (count > kMostCloudPoints) {
    throw UsageError(what + ": it has more than " + std::to_string(kMostCloudPoints) + " ranges");
  }
  if (const std::string wrong = wrong_in(scan); !wrong.empty()) {
    throw UsageError(what + ": " + wrong);
  }
  const auto far = std::ranges::count_if(scan.ranges_m, [](double range_m) {
    return std::isfinite(range_m) && range_m * 1000 > kFarthestMm;
  });
  demand_metres(static_cast<std::size_t>(far), count, what);
  SeenCloud cloud{.time_us = scan.stamp_us};
  if (count > 1) {
    cloud.view_deg = std::abs(scan.step_rad) * static_cast<double>(count) * 180 / std::numbers::pi;
  }
  cloud.has_times = scan.apart_s > 0 && scan.apart_s * static_cast<double>(count) <= 1;
  cloud.has_wrong_times = scan.apart_s != 0 && count > 0 && !cloud.has_times;
  cloud.is_at_once = scan.apart_s == 0 && count > 1;
  const double most_mm = std::round(scan.most_m * 1000);
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
    const double range_mm = std::round(range_m * 1000);
    const bool is_seen = range_mm < most_mm && range_mm < lidar::kMaxRangeMm;
    cloud.at_range_max += range_mm == most_mm ? 1U : 0U;
    point.third = is_seen ? static_cast<std::int32_t>(range_mm) : 0;
    point.flags = is_seen ? std::uint8_t{0} : lidar::PointsPacket::kNothing;
    if (cloud.has_times) {
      point.after_us =
          static_cast<std::uint32_t>(std::lround(static_cast<double>(i) * scan.apart_s * 1e6));
    }
  }
  return cloud;
}

}  // namespace iog::tools
