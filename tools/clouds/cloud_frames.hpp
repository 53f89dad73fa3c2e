// Frames in which clouds are no longer as their sensor saw them: those of the world and of the
// vehicle (REP 105).
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "tools/formats/ros/recorded_messages.hpp"

namespace iog::tools {

using FrameNames = std::set<std::string, std::less<>>;

inline constexpr std::string_view kOdometryType = "nav_msgs/msg/Odometry";

// The frame whose poses a message of odometry has. UsageError if the message is cut off.
[[nodiscard]] std::string frame_of_odometry(const ros::RecordedMessage& message);

// The frames of the odometry that comes before the 20th cloud of a recording; what cannot be read
// is left out.
[[nodiscard]] FrameNames frames_of_odometry(const std::string& path);

// "in frame base_link, which is the vehicle's, but points must be in the sensor's frame: …"; empty
// if the frame may be a sensor's.
[[nodiscard]] std::string words_of_wrong_frame(const std::string& frame,
                                               const FrameNames& of_odometry);

}  // namespace iog::tools
