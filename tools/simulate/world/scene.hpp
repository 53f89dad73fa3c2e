// A scene of the simulator: a road, what stands along it, and how everything on it moves. Each
// scene has files of its own that make it (city.hpp, ring_road.hpp); the simulator knows no more of
// it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tools/simulate/world/attitude.hpp"
#include "tools/simulate/world/landscape.hpp"
#include "tools/simulate/world/moving_solid.hpp"
#include "tools/simulate/world/road.hpp"
#include "tools/simulate/world/site_plan.hpp"
#include "tools/simulate/world/terrain.hpp"
#include "tools/simulate/world/traffic.hpp"

namespace iog::tools {

struct Scene {
  Road road;
  Cruise cruise;
  Landscape landscape;
  Traffic traffic;
  SitePlan plan{};
  std::shared_ptr<const Terrain> terrain{};  // nullptr: flat ground
  std::optional<Attitude> attitude{};        // none: the car nods by 0.2 degrees and no more

  [[nodiscard]] EgoPose ego_at(double time_s) const;

  [[nodiscard]] double ground_at(double x, double y) const {
    return terrain ? terrain->height_at(x, y) : 0;
  }
  // The way along a ray to the ground; kNoHit if it does not come there within `farthest` metres,
  // or, on flat ground, at all.
  [[nodiscard]] double distance_to_ground(const Ray& ray, double farthest) const;

  // Appends everything that may be seen from the car at that time.
  void append_seen_at(double time_s, std::vector<Solid>& solids) const;

  // The same for an interval of some milliseconds: everything that is seen in its middle, and how
  // it moves meanwhile.
  [[nodiscard]] std::vector<MovingSolid> solids_between(double from_s, double to_s) const;

 private:
  void append_traffic(double station, double time_s, std::vector<Solid>& solids) const;
};

}  // namespace iog::tools
