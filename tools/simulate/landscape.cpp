#include "tools/simulate/landscape.hpp"

#include <algorithm>

#include "tools/simulate/road.hpp"

namespace iog::tools {

void Landscape::place(double station, std::vector<Solid>& solids) {
  for (const Solid& solid : solids) {
    standing_.push_back({station, solid});
  }
  solids.clear();
}

void Landscape::sort() { std::ranges::stable_sort(standing_, {}, &Standing::station); }

void Landscape::append_seen_from(double station, std::vector<Solid>& solids) const {
  const auto first = std::ranges::lower_bound(standing_, station - kSight, {}, &Standing::station);
  const auto last = std::ranges::upper_bound(standing_, station + kSight, {}, &Standing::station);
  for (auto it = first; it != last; ++it) {
    solids.push_back(it->solid);
  }
}

}  // namespace iog::tools
