// A frame of a fixed capture on one Cortex-A9: its instructions, which were measured, and the rate
// that they mean at 1 GHz, which is modelled: an assumed number of them is executed in a cycle.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tools/tables/section.hpp"

namespace iog::tools {

// The drives of bench/cortex_a9.txt; the scene is one of those of `iog simulate`.
inline constexpr std::uint64_t kA9Seed = 1;
inline constexpr std::uint32_t kA9Seconds = 2;

// Instructions per cycle: what is assumed, as in docs/figures.md.
inline constexpr double kQuick = 1.0;
inline constexpr double kSlow = 0.5;

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

// std::out_of_range if bench/cortex_a9.txt has no such run.
[[nodiscard]] A9Frame a9_frame(std::string_view scene, int sensors);

// The same for one of the kinds of `iog worst`, four sensors.
[[nodiscard]] A9Frame a9_worst_frame(std::string_view name);

// How often a second one core at 1 GHz executes so many instructions.
[[nodiscard]] double modelled_hz(double instructions, double per_cycle);

// "29.5 to 59.1": what the assumptions leave open, the worse first.
[[nodiscard]] std::string range(double slow, double quick, int decimals);

// Of a number of which more is better. Decided by what it is at least, so that it does not hang on
// the more favourable assumption.
[[nodiscard]] Verdict verdict_on(double paper, double slow);

}  // namespace iog::tools
