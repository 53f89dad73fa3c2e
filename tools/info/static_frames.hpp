// Locates a sensor's frame in its vehicle by the static transforms of a recording (/tf_static).
#pragma once

#include <map>
#include <string>

#include "tools/formats/ros/recorded_messages.hpp"
#include "tools/poses/rigid.hpp"

namespace iog::tools {

class StaticFrames {
 public:
  // A tf2_msgs/TFMessage. UsageError if it is cut off.
  void add(const ros::RecordedMessage& message);

  // The `mount` line of a car file for a sensor in this frame. Empty if no transforms lead from the
  // frame to base_link. If they lead on to base_footprint, which is on the ground (REP 120), the
  // mount is in base_footprint.
  [[nodiscard]] std::string mount_of(const std::string& frame) const;

 private:
  struct Place {
    std::string parent;
    Rigid in_parent;
  };

  std::map<std::string, Place> frames_;
};

}  // namespace iog::tools
