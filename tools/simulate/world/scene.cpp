#include "tools/simulate/world/scene.hpp"

#include <algorithm>
#include <cstddef>

namespace iog::tools {

// A thing comes in the same order and with as many solids at both times; at the limit of sight it
// may be missing in one of them, and is left out.
std::vector<MovingSolid> Scene::solids_between(double from_s, double to_s) const {
  const double station = cruise.station_at((from_s + to_s) / 2);
  std::vector<Solid> standing;
  std::vector<Solid> before;
  std::vector<Solid> after;
  landscape.append_seen_from(station, standing);
  traffic.append_seen_from(station, road, cruise, from_s, before);
  traffic.append_seen_from(station, road, cruise, to_s, after);
  std::vector<MovingSolid> solids;
  solids.reserve(standing.size() + before.size());
  for (const Solid& solid : standing) {
    solids.push_back({solid, solid.at});
  }
  auto next = after.begin();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto same = std::ranges::find(next, after.end(), before[i].thing, &Solid::thing);
    if (same != after.end()) {
      solids.push_back({before[i], same->at});
      next = same + 1;
    }
  }
  return solids;
}

}  // namespace iog::tools
