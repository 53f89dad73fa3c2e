// The things a street is made of, each put together from solids.
#pragma once

#include <vector>

#include "tools/simulate/random.hpp"
#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

inline constexpr double kCarClearance = 0.18;

// Sizes in metres.
struct CarShape {
  double length = 4.2;
  double width = 1.75;
  double bonnet_height = 0.90;
  double roof_height = 1.48;
  double cabin_share = 0.55;  // of the length
  double clearance = kCarClearance;
};

// A box from above the wheels on: the sides of a lorry and its trailer are guarded below.
inline constexpr CarShape kLorry{.length = 16.5,
                                 .width = 2.5,
                                 .bonnet_height = 3.9,
                                 .roof_height = 3.9,
                                 .cabin_share = 0,
                                 .clearance = 0.45};

[[nodiscard]] CarShape some_car(Random& random);

// The body from above the road to the bonnet, and the cabin on it; of a van or a lorry one box.
void add_car(const CarShape& shape, const Placement& at, std::vector<Solid>& solids);

// The same with windows, through which beams pass: on the body stand three pillars to either side
// and carry the roof.
void add_glazed_car(const CarShape& shape, const Placement& at, std::vector<Solid>& solids);

void add_person(double x, double y, std::vector<Solid>& solids);

// A trunk, and leaves from above head height.
void add_tree(double x, double y, Random& random, std::vector<Solid>& solids);

void add_bush(double x, double y, Random& random, std::vector<Solid>& solids);

}  // namespace iog::tools
