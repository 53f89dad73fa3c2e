// What stands along a simulated road and does not move, each thing at its station.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/simulate/world/road.hpp"
#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

class Landscape {
 public:
  // Takes the solids, which stand at this station, and leaves the list empty. Stations may come in
  // any order. Each is a thing of its own, but what begins high above the ground is a part of the
  // one before it: a tree's leaves, a car's cabin.
  void place(double station, std::vector<Solid>& solids);

  // Takes the parked cars away between these stations on one side of the road. side: 1 is left, -1
  // is right.
  void clear_of_cars(const Road& road, double from, double to, double side);

  // After the last place().
  void sort();

  // Appends everything that may be seen from that station, by ascending station; what stands at one
  // station is appended in the order of place(). Only after sort().
  void append_seen_from(double station, std::vector<Solid>& solids) const;

 private:
  struct Standing {
    double station;
    Solid solid;
  };
  std::vector<Standing> standing_;
  std::uint32_t things_ = 0;
};

}  // namespace iog::tools
