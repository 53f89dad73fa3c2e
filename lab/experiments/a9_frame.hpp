// A frame of a fixed capture on one Cortex-A9: its instructions, which were measured. What they
// take is in a9_cycles.hpp.
#pragma once

#include <cstdint>
#include <string_view>

namespace iog::lab {

// The drives of lab/target/cortex_a9.txt; the scene is one of those of `iog simulate`.
inline constexpr std::uint64_t kA9Seed = 1;
inline constexpr std::uint32_t kA9Seconds = 2;

// Counts and instructions: means over the capture's frames unless said otherwise.
struct A9Frame {
  int sensors = 0;
  double points = 0;
  double points_used = 0;
  double cells = 0;    // carved
  double tiles = 0;    // in which something is known
  double receive = 0;  // instructions, as all below
  double fuse = 0;
  double mark = 0;
  double publish = 0;  // with clearing
  double fused = 0;    // fuse + mark + clear
  double whole = 0;    // receive + fuse + mark + publish
  double largest = 0;  // the whole of the dearest frame
};

// std::out_of_range if lab/target/cortex_a9.txt has no such run.
[[nodiscard]] A9Frame a9_frame(std::string_view scene, int sensors);

// The same for one of the kinds of `worst_frames`, four sensors.
[[nodiscard]] A9Frame a9_worst_frame(std::string_view name);

}  // namespace iog::lab
