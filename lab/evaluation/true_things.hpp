// What is true of points of a simulated world at one time: whether something stands or moves there,
// or within 0.2 m of there.
//
// A thing is where its solids are that reach into the vehicle's height band. Their outlines are
// grown by kNearM on every side (a box stays a box), because a range is 0.1 m off and a cell is
// 0.1 m wide. Things that can move are cars and people; what moves is faster than
// tools::kStandingMps. What stood still for less than a second before is settling: it is neither
// held to stand nor to move. Where several things are, what moves is named before what settles, and
// that before what stands.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/simulate/world/scene.hpp"

namespace iog::lab {

inline constexpr double kNearM = 0.2;
inline constexpr double kSettlesS = 1.0;

// By tools::Material.
inline constexpr std::array<std::string_view, 9> kMaterialNames{
    "ground", "wall", "car", "pole", "kerb", "person", "foliage", "rail", "bank"};

enum class TrueState : std::uint8_t { kNothing, kStanding, kSettling, kMovingCar, kMovingPerson };

[[nodiscard]] constexpr bool moves(TrueState state) {
  return state == TrueState::kMovingCar || state == TrueState::kMovingPerson;
}

struct TrueThing {
  TrueState state = TrueState::kNothing;
  std::uint32_t thing = 0;                              // its number, 0 where nothing is
  tools::Material material = tools::Material::kGround;  // of its part that is there
};

// Where something that moves is, by the middle of its longest solid, and how fast: metres and
// metres a second, of the world.
struct TrueMotion {
  bool is_person = false;
  double x_m = 0;
  double y_m = 0;
  double x_mps = 0;
  double y_mps = 0;
};

class TrueThings {
 public:
  // Everything that may be seen from the car at that time of the drive.
  TrueThings(const tools::Scene& scene, double time_s, const description::Description& description);

  // What is within kNearM of a point of the world, metres.
  [[nodiscard]] TrueThing near(double x_m, double y_m) const;

  // Of all things that can be seen, by number, what they do.
  [[nodiscard]] const std::map<std::uint32_t, TrueState>& states() const { return states_; }

  // Of all things that can be seen and move, by number.
  [[nodiscard]] std::map<std::uint32_t, TrueMotion> motions() const;

  // The outlines, without what they were grown by, of a thing's solids.
  [[nodiscard]] std::vector<tools::Solid> outlines_of(std::uint32_t thing) const;

  // Whether something moves or settles within kNearM.
  [[nodiscard]] bool is_near_mover(double x_m, double y_m) const;

 private:
  struct Part {
    tools::Solid grown;
    TrueThing what;
    double reach;  // no point of it is farther from its middle
  };
  [[nodiscard]] static bool covers(const Part& part, double x_m, double y_m);

  std::map<std::uint32_t, TrueState> states_;
  std::map<std::uint32_t, tools::MovingSolid> movers_;  // the longest solid of each
  std::vector<Part> parts_;                             // what moves first, then what settles
  std::size_t mover_parts_ = 0;                         // of both
};

}  // namespace iog::lab
