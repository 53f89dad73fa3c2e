// What the cost model of the Cortex-A9 says of the runs in bench/cortex_a9.txt (docs/a9_model.md):
// cycles, which at 1 GHz are nanoseconds, and misses. Modelled, in its three variants.
#pragma once

#include <string>
#include <string_view>

#include "tools/tables/section.hpp"

namespace iog::tools {

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

// A frame of the drives of a9_frame(), over the first of them.
struct A9Cycles {
  double frames = 0;
  StageCost receive;
  StageCost decode;
  StageCost fuse;
  StageCost mark;
  StageCost clear;
  StageCost publish;  // with clearing
  StageCost fused;    // decode + fuse + mark + clear
  StageCost whole;    // receive + decode + fuse + mark + publish
};

// std::out_of_range if bench/cortex_a9.txt has no such run.
[[nodiscard]] A9Cycles a9_cycles(std::string_view scene, int sensors);

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

}  // namespace iog::tools
