// Whether poses are those of a drive: its motion by the lidar and by the poses, second by second.
#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/odometry/drive_motion.hpp"
#include "tools/poses/pose_sample.hpp"

namespace iog::tools {

// Sums over stretches of a second in which both are known.
struct MotionCheck {
  std::size_t stretches = 0;
  // Of stretches in which the car moves:
  double lidar_m = 0;
  double poses_m = 0;
  std::complex<double> product{};  // of both ways: its angle is how far the lidar's is to the left
  // Of all:
  double lidar_rad = 0;  // turned, to either side
  double poses_rad = 0;
  double off_rad = 0;  // differences of both turns
};

// Both by rising times. offset_us is added to the times of the poses. Stretches in which the poses
// jump or repeat themselves count only if the car moves in no other one.
[[nodiscard]] MotionCheck check_of(std::span<const TurnPose> turns,
                                   std::span<const PoseSample> poses, std::int64_t offset_us = 0);

// How they contradict each other: "in 51 m, the lidar moves 90 degrees to the left of where the
// poses do". Empty if they do not, or if the car hardly moved.
[[nodiscard]] std::string words_of(const MotionCheck& check);

// The same of samples of a drive: its first seconds, after 6 s, 18 s, 36 s and so on.
class MotionWatch {
 public:
  // The car outlives it. If it has no spinning lidar, nothing is watched.
  explicit MotionWatch(const CatalogueEntry& car);

  // The next datagram of the capture, by whose times packets and poses belong together.
  void take(const CapturedDatagram& datagram);
  [[nodiscard]] std::string words() const { return words_of(check_of(turns_, poses_)); }
  // How many poses are kept: a drive may last for hours.
  [[nodiscard]] std::size_t poses() const { return poses_.size(); }

 private:
  void take_pose(const CapturedDatagram& datagram);
  void take_packet(const CapturedDatagram& datagram);

  const CatalogueEntry* car_;
  bool is_watched_;
  std::optional<TurnPoints> points_;  // of the sample that has begun
  std::uint64_t samples_ = 0;
  std::uint64_t begin_us_ = 0;  // of that sample
  Odometry odometry_;
  std::vector<TurnPose> turns_;
  std::vector<PoseSample> poses_;  // around the samples
  std::size_t spare_ = 0;          // of these the last ones, outside of a sample
};

}  // namespace iog::tools
