// Parameters of the perception grid, which are part of the description of a vehicle.
#pragma once

#include <cstdint>

#include "ageing/discounting.hpp"
#include "ageing/gains.hpp"
#include "evidence/assignment.hpp"

namespace iog::perception {

// Which hits on free ground count as moved.
enum class Moved : std::uint8_t {
  kOpenGround,  // see perception/arrivals.hpp
  kLiteral,     // all of them (Kurdej 2015, section 5.2), for comparison
};

// Cycles of a Cortex-A9 at 1 GHz to age, fuse and decide a group with evidence, by the nominal cost
// model, rounded up (docs/results/perception_time.md).
inline constexpr std::uint32_t kGroupCycles = 500;

// The most groups that are fused in a frame: what one core can process in the 40 ms of a frame.
// Groups with hits come first (perception/window_fusion.hpp).
inline constexpr std::uint32_t kGroupBudget = 65'536;
static_assert(kGroupBudget * kGroupCycles <= 40'000'000);

// A hit counts as moved only near a tall hit: at most this many cells away along either axis. The
// larger distance is for sensors whose hits must also be tall above the highest ground nearby
// (ground/ground.hpp), because fewer of their hits are tall.
inline constexpr int kTallWithin = 3;
inline constexpr int kTallOverGroundWithin = 8;

struct Rules {
  ageing::Discounting discounting = ageing::Discounting::kConservative;
  ageing::Weighing weighing = ageing::Weighing::kByTime;
  // Masses by index, in static storage. Without it all hits have the same mass.
  const evidence::Assignment* assignment = nullptr;
  Moved moved = Moved::kOpenGround;
  // Whether only low beams open ground (perception/opening.hpp): true if a sensor specifies low_mm
  // and tall_mm.
  bool is_opened_from_below = false;
  // Whether, in that case, only low beams free occupied cells: true if a sensor is high enough to
  // look over objects.
  bool looks_over_things = true;
  // kTallWithin or kTallOverGroundWithin.
  int tall_within = kTallWithin;
  std::uint32_t group_budget = kGroupBudget;
};

}  // namespace iog::perception
