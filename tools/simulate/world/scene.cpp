#include "tools/simulate/world/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "numeric/elementary.hpp"

namespace iog::tools {
namespace {

// Between the axles and the wheels of an axle, from the middle.
constexpr double kHalfBaseM = 1.35;
constexpr double kHalfTrackM = 0.75;

// Turns an angle that is known by its cosine and sine further.
void add_angle(double angle, double& cos, double& sin) {
  const double more_cos = numeric::cos(angle);
  const double more_sin = numeric::sin(angle);
  const double before = cos;
  cos = cos * more_cos - sin * more_sin;
  sin = sin * more_cos + before * more_sin;
}

// The car with its wheels on the ground.
void stand(const Terrain& terrain, EgoPose& ego) {
  const Footing ground = terrain.under(ego.at, kHalfBaseM, kHalfTrackM);
  ego.z = ground.z;
  const double nod_cos = ego.pitch_cos;
  const double nod_sin = ego.pitch_sin;
  const double length = std::sqrt(1 + ground.along * ground.along);
  ego.pitch_cos = (nod_cos + nod_sin * ground.along) / length;
  ego.pitch_sin = (nod_sin - nod_cos * ground.along) / length;
  const double width = std::sqrt(1 + ground.left * ground.left);
  ego.roll_cos = 1 / width;
  ego.roll_sin = ground.left / width;
}

}  // namespace

EgoPose Scene::ego_at(double time_s) const {
  EgoPose ego = cruise.pose_at(road, time_s);
  if (terrain) {
    stand(*terrain, ego);
  }
  if (attitude) {
    const Lean lean = attitude->at(time_s);
    add_angle(lean.pitch, ego.pitch_cos, ego.pitch_sin);
    add_angle(lean.roll, ego.roll_cos, ego.roll_sin);
    ego.z += lean.heave_m;
  }
  return ego;
}

double Scene::distance_to_ground(const Ray& ray, double farthest) const {
  if (terrain) {
    return terrain->distance_to_ground(ray, farthest);
  }
  return ray.along.z < 0 ? ray.from.z / -ray.along.z : kNoHit;
}

void Scene::append_seen_at(double time_s, std::vector<Solid>& solids) const {
  const double station = cruise.station_at(time_s);
  landscape.append_seen_from(station, solids);
  append_traffic(station, time_s, solids);
}

// Each thing's parts follow one another.
void Scene::append_traffic(double station, double time_s, std::vector<Solid>& solids) const {
  const std::size_t first = solids.size();
  traffic.append_seen_from(station, road, cruise, time_s, solids);
  if (!terrain) {
    return;
  }
  for (auto begin = solids.begin() + static_cast<std::ptrdiff_t>(first); begin != solids.end();) {
    const auto end = std::find_if(begin, solids.end(),
                                  [&](const Solid& part) { return part.thing != begin->thing; });
    terrain->put(std::span(begin, end));
    begin = end;
  }
}

// A thing comes in the same order and with as many solids at both times; at the limit of sight it
// may be missing in one of them, and is left out.
std::vector<MovingSolid> Scene::solids_between(double from_s, double to_s) const {
  const double station = cruise.station_at((from_s + to_s) / 2);
  std::vector<Solid> standing;
  std::vector<Solid> before;
  std::vector<Solid> after;
  landscape.append_seen_from(station, standing);
  append_traffic(station, from_s, before);
  append_traffic(station, to_s, after);
  std::vector<MovingSolid> solids;
  solids.reserve(standing.size() + before.size());
  for (const Solid& solid : standing) {
    solids.push_back({solid, solid.at, solid.footing});
  }
  auto next = after.begin();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto same = std::ranges::find(next, after.end(), before[i].thing, &Solid::thing);
    if (same != after.end()) {
      solids.push_back({before[i], same->at, same->footing});
      next = same + 1;
    }
  }
  return solids;
}

}  // namespace iog::tools
