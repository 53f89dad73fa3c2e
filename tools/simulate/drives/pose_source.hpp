// The poses that a simulated car says of itself, with errors that are stated.
//
// The error of each coordinate and of the heading wanders: it forgets itself with a time constant
// of one second (Ornstein and Uhlenbeck), and the error of the motion during a second has the
// standard deviation that the message states. Errors do not add up beyond that, so the local frame
// stays the world of the truth. Speed and yaw rate are off by as much in a second, anew in each
// message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/poses/pose_sample.hpp"
#include "tools/simulate/world/scene.hpp"

namespace iog::tools {

struct PoseOptions {
  // Nothing is sent of what is measured from begin_s on for so long.
  struct Gap {
    double begin_s;
    double length_s;
  };
  // From time_s on all positions are so far to the left of where they would have been, seen from
  // the car at that time.
  struct Jump {
    double time_s;
    double metres;
  };

  // What is measured from begin_s on for so long is where the car was at begin_s, and standing.
  struct Freeze {
    double begin_s;
    double length_s;
  };

  // From begin_s on all positions swing to the left and right of where they would have been, seen
  // from the car at that time: by so much from one side to the other, first to the left. The speed
  // that is said does not.
  struct Swing {
    double begin_s;
    double metres;
    double period_s;
  };

  double rate_hz = 100;  // 1 ... 125
  double sigma_m = 0.02;
  double sigma_heading_rad = 0.001;
  std::vector<Gap> gaps{};
  std::vector<Jump> jumps{};
  std::vector<Freeze> freezes{};
  std::vector<Swing> swings{};
  std::vector<double> restarts_s{};         // from then on the source has another run
  std::optional<pose::MapTransform> map{};  // what each message says of the map
};

// What is true of the car at that time: its pose, speed and yaw rate. Time and run are left alone.
[[nodiscard]] PoseSample true_pose(const Scene& scene, double time_s);

// The samples of a drive, in order of their times, of which the first is at the drive's begin. The
// same scene, options and seed make the same samples. Measured to sent are 2 to 3 ms.
[[nodiscard]] std::vector<PoseSample> simulated_poses(const Scene& scene,
                                                      const PoseOptions& options,
                                                      std::uint64_t seed, double drive_s);

// Samples on their way into a capture, to the car's UDP port.
class PoseFeed {
 public:
  explicit PoseFeed(std::vector<PoseSample> samples, std::uint16_t udp_port = pose::kPosePort);

  // The datagrams that are sent up to that time and have not been taken before.
  [[nodiscard]] std::vector<CapturedDatagram> take_until(std::uint64_t time_us);

 private:
  std::vector<PoseSample> samples_;
  std::uint16_t udp_port_;
  std::size_t next_ = 0;
  PoseEncoder encoder_;
};

// The datagrams of a frame and the poses that are sent until its last one, in order of time.
[[nodiscard]] std::vector<CapturedDatagram> with_poses(std::vector<CapturedDatagram> datagrams,
                                                       PoseFeed& poses);

}  // namespace iog::tools
