// By which rules a window is kept: part of a vehicle's description.
#pragma once

#include <cstdint>

#include "ageing/discounting.hpp"
#include "ageing/gains.hpp"
#include "evidence/assignment.hpp"

namespace iog::perception {

// Which hits on free ground are on something that moves.
enum class Moved : std::uint8_t {
  kOpenGround,  // perception/arrivals.hpp
  kLiteral,     // all of them (Kurdej 2015, section 5.2), for comparison
};

// What a group with evidence takes a Cortex-A9 at 1 GHz to age, fuse and decide, by the nominal
// cost model, rounded up (docs/results/perception_time.md).
inline constexpr std::uint32_t kGroupCycles = 500;

// Groups that are fused in a frame: not more than a core gets done in the 40 ms of a frame. Those
// with hits come first (perception/window_fusion.hpp).
inline constexpr std::uint32_t kGroupBudget = 65'536;
static_assert(kGroupBudget * kGroupCycles <= 40'000'000);

// So many cells away along either axis, at most, is the tall hit beside which a hit can arrive; and
// where few are tall, because they have to be so over the highest ground nearby, too
// (ground/ground.hpp).
inline constexpr int kTallWithin = 3;
inline constexpr int kTallOverGroundWithin = 8;

struct Rules {
  ageing::Discounting discounting = ageing::Discounting::kConservative;
  ageing::Weighing weighing = ageing::Weighing::kByTime;
  // Masses by index; without it all hits have one mass. Of static storage.
  const evidence::Assignment* assignment = nullptr;
  Moved moved = Moved::kOpenGround;
  // Ground is opened only from below (perception/opening.hpp): one of the sensors says how low and
  // how tall.
  bool is_opened_from_below = false;
  // What is taken gives way to low beams alone then, because a sensor is higher than they are.
  bool looks_over_things = true;
  // kTallWithin or kTallOverGroundWithin.
  int tall_within = kTallWithin;
  std::uint32_t group_budget = kGroupBudget;
};

}  // namespace iog::perception
