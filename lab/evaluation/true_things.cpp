#include "lab/evaluation/true_things.hpp"

#include <algorithm>
#include <cmath>

namespace iog::lab {
namespace {

constexpr double kMomentS = 0.001;  // in which a speed is measured

bool can_move(tools::Material material) {
  return material == tools::Material::kCar || material == tools::Material::kPerson;
}

// Where the first solid of each thing of the traffic was a little before, by its number.
std::map<std::uint32_t, tools::Vector3> places_before(const tools::Scene& scene, double time_s) {
  std::map<std::uint32_t, tools::Vector3> places;
  std::vector<tools::Solid> solids;
  scene.traffic.append_seen_from(scene.cruise.station_at(time_s), scene.road, scene.cruise,
                                 time_s - kSettlesS, solids);
  for (const tools::Solid& solid : solids) {
    places.try_emplace(solid.thing, tools::Vector3{solid.at.x, solid.at.y, 0});
  }
  return places;
}

TrueState state_of(const tools::MovingSolid& solid,
                   const std::map<std::uint32_t, tools::Vector3>& before) {
  if (!can_move(solid.begin.material)) {
    return TrueState::kStanding;
  }
  if (solid.way() > tools::kStandingMps * kMomentS) {
    return solid.begin.material == tools::Material::kCar ? TrueState::kMovingCar
                                                         : TrueState::kMovingPerson;
  }
  constexpr double kRestM = 0.01;
  const auto place = before.find(solid.begin.thing);
  const bool has_stood = solid.begin.thing < tools::kFirstMover || place == before.end() ||
                         (std::abs(place->second.x - solid.begin.at.x) < kRestM &&
                          std::abs(place->second.y - solid.begin.at.y) < kRestM);
  return has_stood ? TrueState::kStanding : TrueState::kSettling;
}

}  // namespace

TrueThings::TrueThings(const tools::Scene& scene, double time_s,
                       const description::Description& description) {
  const auto before = places_before(scene, time_s);
  for (const tools::MovingSolid& solid :
       scene.solids_between(time_s - kMomentS / 2, time_s + kMomentS / 2)) {
    const TrueState state =
        states_.try_emplace(solid.begin.thing, state_of(solid, before)).first->second;
    if (moves(state)) {
      const auto longest = movers_.try_emplace(solid.begin.thing, solid).first;
      if (solid.begin.half_length > longest->second.begin.half_length) {
        longest->second = solid;
      }
    }
    if (solid.begin.z_low > description.z_max_m || solid.begin.z_high < description.z_min_m) {
      continue;
    }
    tools::Solid grown = solid.at(0.5);
    grown.half_length += kNearM;
    grown.half_width += kNearM;
    parts_.push_back({.grown = grown,
                      .what = {state, grown.thing, grown.material},
                      .reach = std::sqrt(grown.half_length * grown.half_length +
                                         grown.half_width * grown.half_width)});
  }
  std::ranges::stable_sort(
      parts_, [](TrueState a, TrueState b) { return a > b; },
      [](const Part& part) { return part.what.state; });
  mover_parts_ =
      static_cast<std::size_t>(std::ranges::find(parts_, TrueState::kStanding,
                                                 [](const Part& part) { return part.what.state; }) -
                               parts_.begin());
}

bool TrueThings::covers(const Part& part, double x_m, double y_m) {
  return std::abs(x_m - part.grown.at.x) <= part.reach &&
         std::abs(y_m - part.grown.at.y) <= part.reach && tools::covers(part.grown, x_m, y_m);
}

TrueThing TrueThings::near(double x_m, double y_m) const {
  const auto found =
      std::ranges::find_if(parts_, [&](const Part& part) { return covers(part, x_m, y_m); });
  return found == parts_.end() ? TrueThing{} : found->what;
}

std::map<std::uint32_t, TrueMotion> TrueThings::motions() const {
  std::map<std::uint32_t, TrueMotion> motions;
  for (const auto& [thing, solid] : movers_) {
    const tools::Placement middle = solid.at(0.5).at;
    motions.emplace(thing, TrueMotion{.is_person = solid.begin.material == tools::Material::kPerson,
                                      .x_m = middle.x,
                                      .y_m = middle.y,
                                      .x_mps = (solid.end.x - solid.begin.at.x) / kMomentS,
                                      .y_mps = (solid.end.y - solid.begin.at.y) / kMomentS});
  }
  return motions;
}

std::vector<tools::Solid> TrueThings::outlines_of(std::uint32_t thing) const {
  std::vector<tools::Solid> outlines;
  for (const Part& part : parts_) {
    if (part.what.thing == thing) {
      outlines.push_back(part.grown);
      outlines.back().half_length -= kNearM;
      outlines.back().half_width -= kNearM;
    }
  }
  return outlines;
}

bool TrueThings::is_near_mover(double x_m, double y_m) const {
  return std::any_of(parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(mover_parts_),
                     [&](const Part& part) { return covers(part, x_m, y_m); });
}

}  // namespace iog::lab
