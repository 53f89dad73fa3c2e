// Locates a sensor's frame in its vehicle by the transforms of a recording that do not change: all
// of /tf_static, and those of /tf that are always the same.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/formats/ros/recorded_messages.hpp"
#include "tools/poses/rigid.hpp"

namespace iog::tools {

class StaticFrames {
 public:
  // A tf2_msgs/TFMessage. UsageError if it is cut off.
  void add(const ros::RecordedMessage& message);

  // The `mount` line of a car file for a sensor in this frame, or a comment if no transforms lead
  // from the frame to base_link. If they lead on to base_footprint, which is on the ground
  // (REP 120), the mount is in base_footprint. Empty if there are no transforms at all, or if the
  // frame is the vehicle's.
  [[nodiscard]] std::string mount_of(const std::string& frame) const;

 private:
  struct Place {
    std::string parent;
    Rigid in_parent;
    bool is_static = false;
    bool moves = false;  // in /tf
  };
  // On the way from a frame to the root.
  struct Step {
    std::string frame;
    Rigid first_in_it{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // the frame where the way begins
    bool is_static = true;                                  // the way
  };

  [[nodiscard]] std::vector<Step> steps_from(const std::string& frame) const;
  // The vehicle's frame and, as first_in_it, the sensor's in it.
  [[nodiscard]] static std::optional<Step> above(const std::vector<Step>& steps);
  [[nodiscard]] std::optional<Step> beside(const std::vector<Step>& steps) const;

  std::map<std::string, Place> frames_;
};

}  // namespace iog::tools
