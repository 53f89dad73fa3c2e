// How far the clock of a log of poses is behind that of a capture, by the motion in both.
#pragma once

#include <span>
#include <string>

#include "tools/odometry/drive_motion.hpp"
#include "tools/poses/pose_sample.hpp"

namespace iog::tools {

struct MotionOffset {
  double seconds = 0;  // to add to the times of the poses
  double sigma_s = 0;
  std::string refusal{};  // why it cannot be told; empty: it can
};

// Compares way and turn of each turn of a lidar with those of the poses in the same time. turns and
// poses: at least one each, by rising times.
[[nodiscard]] MotionOffset offset_by_motion(std::span<const TurnPose> turns,
                                            std::span<const PoseSample> poses);

// "the packets are 0.512 s ahead of the poses by their motion (sigma 4 ms)".
[[nodiscard]] std::string words_of(const MotionOffset& offset);

}  // namespace iog::tools
