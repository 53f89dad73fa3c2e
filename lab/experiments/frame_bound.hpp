// What a frame of the reference car can cost the Cortex-A9 at most.
//
// The bound is counts times costs. The counts follow from the constants of the code: how many
// points a scan may have, how many cells a line may cross, how many tiles there are. The costs are
// the largest that the worst frames (lab/target/cortex_a9.txt) show of a point, a cell, a mark, a
// tile.
#pragma once

namespace iog::lab {

struct FrameBound {
  double points = 0;          // of all scans
  double cells_per_beam = 0;  // of the sensor that sees furthest
  double cells = 0;
  double tiles = 0;
  double per_point = 0;  // instructions
  double per_cell = 0;
  double per_mark = 0;
  double per_tile = 0;
  double receive = 0;  // of the packets in which `worst_frames` sends as many points
  [[nodiscard]] double fuse_and_mark() const {
    return points * (per_point + per_mark) + cells * per_cell;
  }
  [[nodiscard]] double publish() const { return tiles * per_tile; }
  [[nodiscard]] double whole() const { return receive + fuse_and_mark() + publish(); }
};

[[nodiscard]] FrameBound frame_bound();

}  // namespace iog::lab
