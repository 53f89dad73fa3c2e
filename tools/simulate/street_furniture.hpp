// The things a street is made of, each put together from solids.
#pragma once

#include <vector>

#include "tools/simulate/random.hpp"
#include "tools/simulate/solid.hpp"

namespace iog::tools {

// Sizes in metres.
struct CarShape {
  double length = 4.2;
  double width = 1.75;
  double bonnet_height = 0.90;
  double roof_height = 1.48;
  double cabin_share = 0.55;  // of the length
};

inline constexpr double kCarClearance = 0.18;

[[nodiscard]] CarShape some_car(Random& random);

// The body from above the road to the bonnet, and the cabin on it; of a van one box.
void add_car(const CarShape& shape, const Placement& at, std::vector<Solid>& solids);

void add_person(double x, double y, std::vector<Solid>& solids);

// A trunk, and leaves from above head height.
void add_tree(double x, double y, Random& random, std::vector<Solid>& solids);

void add_bush(double x, double y, Random& random, std::vector<Solid>& solids);

}  // namespace iog::tools
