// Parameters of the perception grid, which are part of a vehicle's description.
#pragma once

#include <cstdint>

#include "ageing/discounting.hpp"
#include "ageing/gains.hpp"
#include "evidence/assignment.hpp"
#include "geometry/grid.hpp"
#include "window/area.hpp"

namespace iog::perception {

// The rule that determines which hits on free ground are classified as moved.
enum class Moved : std::uint8_t {
  kOpenGround,  // see perception/arrivals.hpp
  kLiteral,     // all of them (Kurdej 2015, section 5.2), for comparison
};

// The number of cycles that a Cortex-A9 at 1 GHz needs to age, fuse and classify a group with
// evidence, rounded up. The number comes from the nominal cost model
// (docs/results/perception_time.md).
inline constexpr std::uint32_t kGroupCycles = 500;

// The maximum number of groups that are fused in a frame. One core can fuse kGroupBudget groups in
// a frame period of 40 ms. Groups with hits take precedence (perception/window_fusion.hpp).
inline constexpr std::uint32_t kGroupBudget = 65'536;
static_assert(kGroupBudget * kGroupCycles <= 40'000'000);

// Converts a length to cells, rounded up.
[[nodiscard]] constexpr int cells_of(int mm, int cell_mm) { return (mm + cell_mm - 1) / cell_mm; }

// A hit is classified as moved only if a tall return is within this distance of it along each axis.
// The larger distance applies if a sensor's tall returns must also be well above the highest ground
// nearby (ground/ground.hpp), because such a sensor has fewer tall returns.
inline constexpr int kTallWithinMm = 300;
inline constexpr int kTallOverGroundWithinMm = 800;
inline constexpr int kTallWithin = cells_of(kTallWithinMm, geometry::kUsualCellMm);
inline constexpr int kTallOverGroundWithin =
    cells_of(kTallOverGroundWithinMm, geometry::kUsualCellMm);

// The distances, in cells, that define the surroundings of a cell in the rules for motion onset and
// open ground. The default values correspond to 0.1, 0.2 and 0.3 m.
struct Around {
  // A hit belongs to a standing object if a standing cell is within this distance.
  int beside = 1;
  // Gaps of up to twice this radius between beams are closed. All cells within this distance of a
  // dense cell must have been observed.
  int gaps = 2;
  // All cells within this distance of an open cell must be free. For each hit, the new hits within
  // this distance are counted.
  int open = 3;
  friend bool operator==(const Around&, const Around&) = default;
};
[[nodiscard]] constexpr Around around_with(int cell_mm) {
  return {.beside = cells_of(100, cell_mm),
          .gaps = cells_of(200, cell_mm),
          .open = cells_of(300, cell_mm)};
}
static_assert(around_with(geometry::kUsualCellMm) == Around{});

struct Rules {
  ageing::Discounting discounting = ageing::Discounting::kConservative;
  ageing::Weighing weighing = ageing::Weighing::kByTime;
  // The tables of a car that defines its own constants, in static storage. If the pointer is null,
  // the default constants are used.
  const ageing::Tables* tables = nullptr;
  // The masses for each index, in static storage. If the pointer is null, all hits have the same
  // mass.
  const evidence::Assignment* assignment = nullptr;
  Moved moved = Moved::kOpenGround;
  // True if only low beams open cells (perception/opening.hpp). The value is true if low_mm and
  // tall_mm are specified for at least one sensor.
  bool is_opened_from_below = false;
  // True if only low beams free occupied cells. `looks_over_things` has an effect only if
  // is_opened_from_below is true. The value is true if a sensor is high enough to see over objects.
  bool looks_over_things = true;
  // Within this distance of the vehicle's reference point, no beam is low enough to open a cell.
  // The value is 0 if a sensor opens cells everywhere.
  std::int32_t blind_mm = 0;
  // Either kTallWithin or kTallOverGroundWithin.
  int tall_within = kTallWithin;
  Around around{};
  std::uint32_t group_budget = kGroupBudget;
  window::Extent extent{};  // of the window
};

}  // namespace iog::perception
