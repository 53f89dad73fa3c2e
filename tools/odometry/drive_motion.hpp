// The motion in a whole capture, and what is written and said of it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/odometry/odometry.hpp"

namespace iog::tools {

// By the turns of the captures, in time and with a bounded map. UsageError as of CaptureSet and
// TurnPoints, or if there are fewer than two whole turns. If most_s is given, it ends after so many
// seconds in which the car moved.
[[nodiscard]] std::vector<TurnPose> motion_in(const std::vector<std::string>& captures,
                                              const CatalogueEntry& car,
                                              std::optional<double> most_s = {});

// From the turn before to this one.
struct TurnMotion {
  double seconds;
  double forward_m;
  double turn_rad;
};
[[nodiscard]] TurnMotion motion_between(const TurnPose& from, const TurnPose& to);

[[nodiscard]] double heading_rad(const Pose& pose);

// The standard deviations of the motion in the second before turn `which`, as poses state them.
struct MotionSigma {
  double position_m;
  double heading_rad;
};
[[nodiscard]] MotionSigma sigma_at(std::span<const TurnPose> turns, std::size_t which);

// As a log that read_pose_log() reads, with a pose every 20 ms or less.
[[nodiscard]] std::string csv_of(std::span<const TurnPose> turns);

// "297 turns in 29.7 s, 285.2 m", and where the surroundings did not determine the motion.
[[nodiscard]] std::string words_of(std::span<const TurnPose> turns);

}  // namespace iog::tools
