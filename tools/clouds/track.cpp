#include "tools/clouds/track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "pose/limits.hpp"

namespace iog::tools {
namespace {

double between(double from, double to, double part) { return from + (to - from) * part; }

std::optional<double> between(const std::optional<double>& from, const std::optional<double>& to,
                              double part) {
  return from && to ? std::optional(between(*from, *to, part)) : std::nullopt;
}

LoggedPose between(const LoggedPose& from, const LoggedPose& to, double part) {
  const double turn = std::remainder(*to.heading_rad - *from.heading_rad, 2 * std::numbers::pi);
  return {.time_us = 0,
          .x_m = between(from.x_m, to.x_m, part),
          .y_m = between(from.y_m, to.y_m, part),
          .heading_rad = *from.heading_rad + turn * part,
          .speed_mps = between(from.speed_mps, to.speed_mps, part),
          .yaw_rate_rps = between(from.yaw_rate_rps, to.yaw_rate_rps, part),
          .sigma_m = between(from.sigma_m, to.sigma_m, part),
          .sigma_heading_rad = between(from.sigma_heading_rad, to.sigma_heading_rad, part)};
}

}  // namespace

Track::Track(PoseLog& log) {
  std::size_t without_heading = 0;
  std::size_t not_newer = 0;
  for (const LoggedPose& pose : log.poses) {
    if (!pose.heading_rad) {
      ++without_heading;
    } else if (!poses_.empty() && pose.time_us <= poses_.back().time_us) {
      ++not_newer;
    } else {
      poses_.push_back(pose);
    }
  }
  remark(without_heading, "pose|poses without a heading", log.remarks);
  remark(not_newer, "pose|poses that is|are not newer than the one before", log.remarks);
}

LoggedPose Track::at(double time_us) const {
  const auto time_of = [](const LoggedPose& pose) { return static_cast<double>(pose.time_us); };
  const auto last = poses_.end() - 2;
  auto from = std::ranges::upper_bound(poses_, time_us, {}, time_of);
  from = from == poses_.begin() ? from : std::min(from - 1, last);
  const LoggedPose& to = *(from + 1);
  LoggedPose pose = between(*from, to, (time_us - time_of(*from)) / (time_of(to) - time_of(*from)));
  pose.time_us = static_cast<std::uint64_t>(time_us);
  return pose;
}

std::vector<LoggedPose> Track::every(std::uint64_t period_us) const {
  std::vector<LoggedPose> found;
  std::uint64_t time_us = poses_.front().time_us;
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    const std::uint64_t next_us = poses_[i].time_us;
    if (next_us - poses_[i - 1].time_us > pose::kLostUs && time_us <= next_us) {
      time_us += ((next_us - time_us) / period_us + 1) * period_us;  // a silence may last years
    }
    for (; time_us <= next_us; time_us += period_us) {
      found.push_back(at(static_cast<double>(time_us)));
    }
  }
  return found;
}

}  // namespace iog::tools
