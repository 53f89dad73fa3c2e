// Where something was at any time, by poses that were logged now and then.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/poses/pose_log.hpp"

namespace iog::tools {

class Track {
 public:
  // Of poses with a heading, by rising times; others are left out, and remarked in the log. At
  // least two are left, or it is empty.
  explicit Track(PoseLog& log);

  [[nodiscard]] bool is_empty() const { return poses_.size() < 2; }

  // The pose at a time. Between two poses it moves and turns evenly, and beyond its ends as it did
  // there. Microseconds since 1970. Not if it is empty.
  [[nodiscard]] LoggedPose at(double time_us) const;

  // A pose each period_us from the first one on; none between two poses that are further apart than
  // a silence that a target bears (pose::kLostUs).
  [[nodiscard]] std::vector<LoggedPose> every(std::uint64_t period_us) const;

 private:
  std::vector<LoggedPose> poses_;
};

}  // namespace iog::tools
