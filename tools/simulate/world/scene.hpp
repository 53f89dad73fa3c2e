// A scene of the simulator: a road, what stands along it, and how everything on it moves. Each
// scene has files of its own that make it (city.hpp, ring_road.hpp); the simulator knows no more of
// it.
#pragma once

#include <vector>

#include "tools/simulate/world/landscape.hpp"
#include "tools/simulate/world/moving_solid.hpp"
#include "tools/simulate/world/road.hpp"
#include "tools/simulate/world/site_plan.hpp"
#include "tools/simulate/world/traffic.hpp"

namespace iog::tools {

struct Scene {
  Road road;
  Cruise cruise;
  Landscape landscape;
  Traffic traffic;
  SitePlan plan{};

  [[nodiscard]] EgoPose ego_at(double time_s) const { return cruise.pose_at(road, time_s); }

  // Appends everything that may be seen from the car at that time.
  void append_seen_at(double time_s, std::vector<Solid>& solids) const {
    const double station = cruise.station_at(time_s);
    landscape.append_seen_from(station, solids);
    traffic.append_seen_from(station, road, cruise, time_s, solids);
  }

  // The same for an interval of some milliseconds: everything that is seen in its middle, and how
  // it moves meanwhile.
  [[nodiscard]] std::vector<MovingSolid> solids_between(double from_s, double to_s) const;
};

}  // namespace iog::tools
