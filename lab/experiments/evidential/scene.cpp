#include "lab/experiments/evidential/scene.hpp"

#include <algorithm>

namespace iog::lab {

namespace thesis = reference::evidential;

thesis::Set SceneMap::classes_at(const LocalToWorld::Point& at) const {
  const auto is_inside = [&at](const tools::Solid& house) {
    return tools::covers(house, at.x_m, at.y_m);
  };
  if (std::ranges::any_of(ghosts_, is_inside)) {
    return thesis::kBuilding;
  }
  switch (ground_.at(at.x_m, at.y_m)) {
    case tools::Ground::kHouse:
      return thesis::kBuilding;
    case tools::Ground::kRoad:
      return thesis::kRoad;
    case tools::Ground::kBeside:
      break;
  }
  return thesis::kIntermediate;
}

std::vector<thesis::Set> SceneMap::classes_of(const Region& region) const {
  std::vector<thesis::Set> classes(region.cell_count());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    classes[i] = classes_at(region.centre_of(i));
  }
  return classes;
}

On on_what(const TrueThing& thing, thesis::Set map_classes) {
  switch (thing.state) {
    case TrueState::kNothing:
      return On::kNothing;
    case TrueState::kSettling:
      return On::kSettling;
    case TrueState::kMovingCar:
      return On::kMovingCar;
    case TrueState::kMovingPerson:
      return On::kMovingPerson;
    case TrueState::kStanding:
      break;
  }
  if (thing.material == tools::Material::kWall) {
    return On::kHouse;
  }
  const bool can_move =
      thing.material == tools::Material::kCar || thing.material == tools::Material::kPerson;
  return can_move && (map_classes & thesis::kRoad) != 0 ? On::kStopped : On::kBeside;
}

}  // namespace iog::lab
