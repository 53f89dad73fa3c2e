// Messages of ROS 2 as clouds, serialised (formats/ros/cdr_writer.hpp): sensor_msgs/PointCloud2,
// sensor_msgs/LaserScan, and CustomMsg of livox_ros_driver; and the recordings that have them or
// Foxglove's.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/clouds/cloud_fields.hpp"
#include "tools/formats/ros/recorded_messages.hpp"

namespace iog::tools {

// Messages in CDR, with the four bytes of its encapsulation. The functions below throw a UsageError
// that begins with `what` for one that is cut off or not little endian.

// Sets unit as cloud_of() does. UsageError as cloud_of().
[[nodiscard]] SeenCloud cloud_of_point_cloud2(std::span<const std::byte> message, TimeUnit& unit,
                                              const std::string& what);

// UsageError as cloud_of_ranges().
[[nodiscard]] SeenCloud cloud_of_laser_scan(std::span<const std::byte> message,
                                            const std::string& what);

// UsageError as cloud_of(), and if its counts of points differ or do not fill its bytes.
[[nodiscard]] SeenCloud cloud_of_livox(std::span<const std::byte> message, const std::string& what);

// Whether messages of this type are clouds or scans.
[[nodiscard]] bool is_cloud_type(std::string_view type);

// Calls take(message) with each message of these types, of tf2_msgs/TFMessage and of
// nav_msgs/Odometry, as ros::for_each_message().
std::vector<std::string> for_each_cloud_or_frame(
    const std::string& path, const std::function<void(const ros::RecordedMessage&)>& take);

// A message of one of these types as a cloud. Sets unit as cloud_of() does. UsageError as the
// functions above.
[[nodiscard]] SeenCloud cloud_of_message(const ros::RecordedMessage& message, TimeUnit& unit);

// The frame that its header names, in which its points are. UsageError if it is cut off.
[[nodiscard]] std::string frame_of(const ros::RecordedMessage& message);

// Calls take(cloud) with each cloud of a topic. An empty topic means the only one that has clouds.
// Sets unit as cloud_of() does. Returns remarks: what is not there. UsageError if the recording
// cannot be read, or if several topics have clouds and none is chosen.
std::vector<std::string> for_each_cloud(const std::string& path, const std::string& topic,
                                        TimeUnit& unit,
                                        const std::function<void(SeenCloud&&)>& take);

}  // namespace iog::tools
