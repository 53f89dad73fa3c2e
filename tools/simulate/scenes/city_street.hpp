// What stands in the simulated city: a street of two lanes with parked cars, kerbs, pavements,
// buildings, parks and junctions.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/simulate/world/landscape.hpp"
#include "tools/simulate/world/road.hpp"
#include "tools/simulate/world/site_plan.hpp"

namespace iog::tools {

// The cross-section, in metres from the centre line.
inline constexpr double kCityLane = 1.75;
inline constexpr double kPavementCentre = 7.60;

struct CityStreet {
  Landscape landscape;
  SitePlan plan;
  std::vector<double> junctions;  // stations of their middles, ascending
};

// For a drive of that length along that road.
[[nodiscard]] CityStreet make_city_street(const Road& road, std::uint64_t seed, double drive_m);

}  // namespace iog::tools
