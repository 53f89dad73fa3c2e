#include "tools/simulate/world/landscape.hpp"

#include <algorithm>

namespace iog::tools {
namespace {

constexpr double kFloats = 0.5;         // metres; a lorry's side begins below
constexpr double kWidestStreet = 10.0;  // from the centre line to a car that is parked beside it

}  // namespace

void Landscape::place(double station, std::vector<Solid>& solids) {
  for (Solid& solid : solids) {
    things_ += solid.z_low > kFloats && things_ > 0 ? 0U : 1U;
    solid.thing = things_;
    standing_.push_back({station, solid});
  }
  solids.clear();
}

void Landscape::clear_of_cars(const Road& road, double from, double to, double side) {
  std::erase_if(standing_, [&](const Standing& standing) {
    if (standing.solid.material != Material::kCar || standing.station < from ||
        standing.station > to) {
      return false;
    }
    const Placement centre = road.at(standing.station, 0);
    const double left = (standing.solid.at.y - centre.y) * centre.cos -
                        (standing.solid.at.x - centre.x) * centre.sin;
    return left * side > 0 && left * side < kWidestStreet;
  });
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
