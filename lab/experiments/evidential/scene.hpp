// What is true of a simulated drive for the evidential thesis: the map of its scene, and what is
// where.
#pragma once

#include <cstdint>
#include <vector>

#include "lab/evaluation/true_things.hpp"
#include "lab/experiments/evidential/scans.hpp"
#include "lab/reference/evidential/perception.hpp"
#include "tools/simulate/truth/true_ground.hpp"
#include "tools/simulate/world/scene.hpp"

namespace iog::lab {

// A scene's houses and carriageways as a map without error would have them.
class SceneMap {
 public:
  explicit SceneMap(const tools::Scene& scene) : ground_(scene.plan) {}

  // One of reference::evidential::kBuilding, kRoad and kIntermediate.
  [[nodiscard]] reference::evidential::Set classes_at(const LocalToWorld::Point& at) const;
  [[nodiscard]] std::vector<reference::evidential::Set> classes_of(const Region& region) const;

  // A house that is mapped and not there. Of what is there now the map knows nothing.
  void add_ghost(const tools::Solid& house) { ghosts_.push_back(house); }

 private:
  tools::TrueGround ground_;
  std::vector<tools::Solid> ghosts_;
};

// What an echo or a piece of ground is on.
enum class On : std::uint8_t {
  kNothing,
  kHouse,
  kStopped,  // a car or a person that stands on the road
  kBeside,   // all else that stands
  kMovingCar,
  kMovingPerson,
  kSettling,  // it has stopped less than a second ago
};
inline constexpr std::size_t kOnCount = 7;

[[nodiscard]] On on_what(const TrueThing& thing, reference::evidential::Set map_classes);

}  // namespace iog::lab
