#include "walk_cost.hpp"

#include <cstddef>
#include <optional>

#include "fan.hpp"
#include "index/occupancy_index.hpp"
#include "lab/a9_model/marker.hpp"
#include "walks.hpp"

namespace iog::lab {
namespace {

constexpr index::OccupancyIndex kFree = -14;

constexpr std::array<BeamEnd, kBeamCount> kFan = make_fan();

template <typename Walk>
using Walks = std::array<std::optional<Walk>, kBeamCount>;

template <typename Walk>
using Ends = std::array<typename Walk::End, kBeamCount>;

// Neither may be inlined: the compiler knows every end of the fan.
template <typename Walk>
[[gnu::noinline]] void set_up(const Ends<Walk>& ends, Walks<Walk>& walks) {
  for (std::size_t beam = 0; beam < kBeamCount; ++beam) {
    walks[beam].emplace(ends[beam]);
  }
}

// A walk is copied so that it is in registers while it goes, as in the product.
template <typename Walk, typename Visit>
[[gnu::noinline]] void run(const Walks<Walk>& walks, Visit visit) {
  for (const std::optional<Walk>& each : walks) {
    Walk walk = *each;
    walk.run(visit);
  }
}

// The region is what the cost model reports.
template <unsigned kRegion, typename Walk>
WalkCost measure(InstructionCounter& counter, const char* name) {
  static std::array<index::OccupancyIndex, kFanCellCount> grid;
  static Ends<Walk> ends;
  static Walks<Walk> walks;
  for (std::size_t beam = 0; beam < kBeamCount; ++beam) {
    ends[beam] = Walk::end_of(kFan[beam]);
  }
  const std::uint32_t start = counter.now();
  set_up<Walk>(ends, walks);
  const std::uint32_t ready = counter.now();
  a9_model::begin_region<kRegion>();
  run(walks, [cells = grid.data()](std::size_t offset) {
    cells[offset] = index::sat_lower(cells[offset], kFree);
  });
  a9_model::end_region<kRegion>();
  const std::uint32_t done = counter.now();
  std::uint32_t visited = 0;
  run(walks, [&visited](std::size_t /*offset*/) { ++visited; });
  return {name, ready - start - counter.of_nothing(), done - ready - counter.of_nothing(), visited};
}

}  // namespace

std::array<WalkCost, kWalkCount> measure_walks(InstructionCounter& counter) {
  return {measure<1, DiscreteWalk<20>>(counter, "discrete r=20"),
          measure<2, DiscreteWalk<100>>(counter, "discrete r=100"),
          measure<3, DiscreteWalk<200>>(counter, "discrete r=200"),
          measure<4, DiscreteWalk<1024>>(counter, "discrete r=1024"),
          measure<5, ContinuousWalk<float>>(counter, "continuous_float"),
          measure<6, ContinuousWalk<double>>(counter, "continuous_double"),
          measure<7, RealErrorWalk<float>>(counter, "float_error"),
          measure<8, BresenhamWalk>(counter, "bresenham")};
}

}  // namespace iog::lab
