// Pose samples as the messages that the target understands (pose/message.hpp).
#pragma once

#include <cstdint>

#include "pose/message.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/poses/pose_sample.hpp"

namespace iog::tools {

// Where the poses of simulated and converted drives come from: 10.0.2.110.
inline constexpr std::uint32_t kPoseSourceIpv4 = 0x0A00026E;

// Every value to the nearest of its unit, a standard deviation upwards, and to the limits of its
// field. UsageError if the target would refuse it: a position beyond 1,000 km, a speed above 100
// m/s, a yaw rate above 10 rad/s, an age above 200 ms, or no number.
[[nodiscard]] pose::Message message_of(const PoseSample& sample);

// Whether position, speed and yaw rate are within those limits.
[[nodiscard]] bool can_be_said(const PoseSample& sample);

// Their parts: as in a message.
[[nodiscard]] pose::Pose wire_pose(double x_m, double y_m, double heading_rad);
[[nodiscard]] pose::Sigma wire_sigma(double position_m, double heading_rad);

// The datagrams of one source, numbered from its run's first.
class PoseEncoder {
 public:
  // Sent when the sample says: time and age together.
  [[nodiscard]] CapturedDatagram datagram_of(const PoseSample& sample);

 private:
  pose::Encoder encoder_;
  std::uint32_t run_ = 0;
};

}  // namespace iog::tools
