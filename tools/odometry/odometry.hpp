// The motion of a car by the scans of its spinning lidars: each turn is registered in a map of the
// turns before. The design is that of KISS-ICP (Vizzo and others, 2023), with planes for points.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "tools/odometry/local_map.hpp"
#include "tools/odometry/scan_match.hpp"
#include "tools/odometry/turn_points.hpp"

namespace iog::tools {

// Where the car was at the end of a turn, in the vehicle frame of the first turn's end.
struct TurnPose {
  std::uint64_t time_us = 0;
  Pose pose = Pose::Identity();
  bool is_sure = true;  // the scan determines the motion since the turn before
  ScanMatch match{};
};

class Odometry {
 public:
  // Turns by rising times. The first one, and one after a silence, begins a new map. The first
  // motion in a map is searched at all speeds of a car, unless the turns confirm the likely speed.
  [[nodiscard]] TurnPose add(Turn turn, std::optional<double> likely_mps = std::nullopt);

 private:
  [[nodiscard]] ScanMatch matched(const Turn& turn, const Pose& predicted) const;
  [[nodiscard]] ScanMatch matched_at(double speed_mps, const Turn& turn);
  [[nodiscard]] ScanMatch best_start(const Turn& turn);
  [[nodiscard]] ScanMatch matched_first(const Turn& turn, std::optional<double> likely_mps);
  [[nodiscard]] double most_off_m() const;
  void learn(const Pose& off);
  void insert(const Turn& turn, const Pose& pose, const Pose& motion);

  LocalMap map_;
  Turn last_;
  std::uint64_t turns_ = 0;  // of this map
  Pose pose_ = Pose::Identity();
  Pose motion_ = Pose::Identity();  // of the last turn
  double seconds_ = 0;              // that it took
  double squares_off_ = 0;          // of what predictions were off
  double off_count_ = 0;
};

// The motion in a part of the time of a body that moves and turns evenly.
[[nodiscard]] Pose part_of(const Pose& motion, double part);

}  // namespace iog::tools
