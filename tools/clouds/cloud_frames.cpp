#include "tools/clouds/cloud_frames.hpp"

#include "tools/clouds/ros_clouds.hpp"
#include "tools/formats/ros/cdr_reader.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools {
namespace {

// As REP 105 names them, and the one in which LOAM and FAST-LIO leave registered clouds.
bool is_of_world(std::string_view frame) {
  const std::string_view name = frame.substr(frame.rfind('/') + 1);  // all of it without a slash
  return name == "odom" || name == "map" || name == "world" || name == "camera_init";
}

}  // namespace

std::string frame_of_odometry(const ros::RecordedMessage& message) {
  ros::CdrReader in(message.data, message.where);
  static_cast<void>(in.stamp_us());
  static_cast<void>(in.text());  // in which it is
  std::string frame = in.text();
  in.must_be_whole();
  return frame;
}

FrameNames frames_of_odometry(const std::string& path) {
  constexpr int kEnoughClouds = 20;
  struct Enough {};
  FrameNames frames;
  int clouds = 0;
  try {
    for_each_cloud_or_frame(path, [&](const ros::RecordedMessage& message) {
      if (message.type == kOdometryType) {
        frames.insert(frame_of_odometry(message));
      } else if (is_cloud_type(message.type) && ++clouds == kEnoughClouds) {
        throw Enough();
      }
    });
  } catch (const Enough&) {
  } catch (const UsageError&) {  // whoever reads the clouds tells it
  }
  return frames;
}

std::string words_of_wrong_frame(const std::string& frame, const FrameNames& of_odometry) {
  const bool is_of_vehicle = robot_of(frame).has_value();
  const bool is_of_odometry = !frame.empty() && of_odometry.contains(frame);
  if (!is_of_world(frame) && !is_of_vehicle && !is_of_odometry) {
    return {};
  }
  const std::string words = "in frame " + printable(frame);
  if (is_of_odometry && !is_of_vehicle && !is_of_world(frame)) {
    // Lidar odometry is in the lidar's own frame.
    return words +
           ", as the odometry is: if it is the vehicle's frame, use the topic of the lidar's "
           "driver; if it is the sensor's, give --poses-mount";
  }
  return words + (is_of_vehicle ? ", which is the vehicle's" : "") +
         ", but points must be in the sensor's frame: use the topic of the lidar's driver";
}

}  // namespace iog::tools
