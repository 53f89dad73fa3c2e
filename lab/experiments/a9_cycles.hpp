// What the cost model of the Cortex-A9 says of the runs in lab/target/cortex_a9.txt
// (docs/a9_model.md): cycles, which at 1 GHz are nanoseconds, and misses. Modelled, in its three
// variants.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "lab/experiments/section.hpp"

namespace iog::lab {

// The same quantity by the three variants.
struct Modelled {
  double nominal = 0;
  double optimistic = 0;
  double pessimistic = 0;

  friend Modelled operator*(const Modelled& value, double factor) {
    return {value.nominal * factor, value.optimistic * factor, value.pessimistic * factor};
  }
};

// What a stage of a mean frame takes; misses by the nominal variant.
struct StageCost {
  Modelled cycles;
  double instructions = 0;
  double l1d_refills = 0;
  double l2_misses = 0;
  double mispredicts = 0;
};

// A frame, taken apart at functions of the core (lab/target/a9_runs.py): an instruction belongs to
// the innermost of them that it is called from, so that the stages add up to the frame.
struct A9Cycles {
  double frames = 0;
  double before = 0;  // frames to warm up, not looked at
  StageCost receive;  // Ethernet, IP and UDP
  StageCost decode;   // sensor messages, found and checked
  StageCost beams;    // points to beams: fate, line, where which index ends
  StageCost carve;    // lower the cells along the lines
  StageCost mark;     // what the points hit
  StageCost encode;   // known tiles found, copied, hashed, encoded, put into protected messages
  StageCost send;     // wrapped into Ethernet frames
  StageCost clear;
  StageCost fuse;     // beams + carve
  StageCost publish;  // encode + send + clear
  StageCost fused;    // decode + fuse + mark + clear
  StageCost whole;    // all of it
};

// What the core keeps of a line from one frame to the next, or what it costs without.
enum class Paths : std::uint8_t { kKept, kForgotten };

// The first frames, but some to warm up, of the drives of a9_frame(). kForgotten only with four
// sensors.
[[nodiscard]] StageCost sum_of(std::initializer_list<StageCost> stages);

// std::out_of_range if lab/target/cortex_a9.txt has no such run.
[[nodiscard]] A9Cycles a9_cycles(std::string_view scene, int sensors, Paths paths = Paths::kKept);

// Four sensors, and tiles sent in their shortest encoding; everywhere else they are sent raw.
[[nodiscard]] A9Cycles a9_shortest(std::string_view scene);

// The same for one of the kinds of `worst_frames`, four sensors.
[[nodiscard]] A9Cycles a9_worst_cycles(std::string_view name, Paths paths = Paths::kKept);

// The same over more frames; four sensors, nominal alone.
[[nodiscard]] A9Cycles a9_long_run(std::string_view scene);

// Each line of the grid of which a frame leaves something known read and written once, sent once
// and cleared once, and nothing else (lab/target/floor.cpp), of a mean frame. Nominal.
struct A9Floor {
  double lines = 0;
  StageCost fuse;
  StageCost send;
  StageCost clear;
  [[nodiscard]] double fused_cycles() const;  // without sending
  [[nodiscard]] double whole_cycles() const;
};
[[nodiscard]] A9Floor a9_floor(std::string_view scene);
[[nodiscard]] A9Floor a9_worst_floor(std::string_view name);

// The linear quadtree of a mean frame, from its tiles (lab/target/tree_cost.cpp).
struct A9Tree {
  double leaves = 0;
  double bytes = 0;
  StageCost cost;
};
[[nodiscard]] A9Tree a9_tree(std::string_view scene);

// A frame of the synthetic load (lab/target/scaling.cpp).
struct A9Load {
  int cells_per_side = 0;
  int cell_mm = 0;
  int sensors = 0;
  int azimuths = 0;  // directions of a layer
  int range_cm = 0;
};
struct A9Scaling {
  double points = 0;
  double messages = 0;
  StageCost fused;  // decode + fuse + mark + clear
  StageCost publish;
  StageCost whole;  // without receiving; nominal alone
};
[[nodiscard]] A9Scaling a9_scaling(const A9Load& load);

// One of the walks of traversal_cost, e.g. "discrete r=20", over all its cells.
[[nodiscard]] StageCost a9_walk(const std::string& walk);

// What so many instructions take at the rate of that stage.
[[nodiscard]] Modelled cycles_of(double instructions, const StageCost& stage);

// How often a second a core at 1 GHz does what takes so many cycles.
[[nodiscard]] Modelled hz_of(const Modelled& cycles);

// "12.4 (10.9 to 16.0)": nominal, and the other two, the smaller one first.
[[nodiscard]] std::string banded(const Modelled& value, int decimals);

// Of a number of which more is better: decided by the nominal variant.
[[nodiscard]] Verdict verdict_by_nominal(double paper, const Modelled& ours);

// Whether the paper's number lies between those of the optimistic and the pessimistic variant, so
// that another variant would have decided otherwise.
[[nodiscard]] bool is_in_band(double paper, const Modelled& ours);

}  // namespace iog::lab
