// What stands along a simulated road and does not move, each thing at its station.
#pragma once

#include <vector>

#include "tools/simulate/solid.hpp"

namespace iog::tools {

class Landscape {
 public:
  // Takes the solids, which stand at this station, and leaves the list empty. Stations may come in
  // any order.
  void place(double station, std::vector<Solid>& solids);

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
};

}  // namespace iog::tools
