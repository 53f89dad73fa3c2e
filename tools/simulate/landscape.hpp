// What stands along a simulated road and does not move, each thing at its station.
#pragma once

#include <vector>

#include "tools/simulate/solid.hpp"

namespace iog::tools {

class Landscape {
 public:
  // Keeps the solids as standing at that station and leaves the list empty. The order of stations
  // is free.
  void place(double station, std::vector<Solid>& solids);

  // After the last place().
  void sort();

  // Appends everything that may be seen from that station: by ascending station, those of one
  // station in the order of their placing. Only after sort().
  void append_seen_from(double station, std::vector<Solid>& solids) const;

 private:
  struct Standing {
    double station;
    Solid solid;
  };
  std::vector<Standing> standing_;
};

}  // namespace iog::tools
