// What of a scene belongs on a map: its roads and its houses, where they truly are.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "tools/simulate/world/road.hpp"
#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

// A carriageway with its parking strips, from kerb to kerb.
struct PlannedRoad {
  std::string_view kind;  // the value of OpenStreetMap's key `highway`
  std::uint32_t lanes = 0;
  bool is_oneway = false;
  double width_m = 0;
  // Its middle, from the begin to the end in the direction in which it is driven. Each placement
  // points along the road or against it.
  std::vector<Placement> line{};
};

// A box with upright walls.
struct PlannedHouse {
  Placement at;  // the centre of its outline
  double half_length_m = 0;
  double half_width_m = 0;
};

struct SitePlan {
  std::vector<PlannedRoad> roads;
  std::vector<PlannedHouse> houses;
};

// The line `left` metres to the left of a road's centre line. Its points are 2 m apart or a little
// less: in a curve of 58 m radius the polygon is at most 9 mm beside it.
[[nodiscard]] std::vector<Placement> line_beside(const Road& road, double from, double to,
                                                 double left);

[[nodiscard]] PlannedHouse house_of(const Solid& box);

}  // namespace iog::tools
