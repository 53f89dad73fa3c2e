// What is true of a point that a simulated scanner sends.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

enum class PointClass : std::uint8_t {
  kGround,          // road, pavement, verge, bank
  kMoving,          // a car or a person faster than kStandingMps
  kMovable,         // a car or a person that stands
  kInfrastructure,  // what cannot move: walls, poles, kerbs, trees, bushes, rails
  kClutter,         // rain, or dirt on the window: nothing is there
  kNothing,         // nothing came back
};

// Of the surface where the beam ends, without the error of the range. Of an echo between two
// surfaces: of the one that the beam's right edge meets.
struct PointTruth {
  PointClass what = PointClass::kNothing;
  std::uint32_t thing = 0;  // Solid::thing; 0: the ground, or nothing
  Vector3 at{};             // in the world; of clutter and of nothing: no place
  double height_m = 0;      // over the ground below it
};

// A datagram and what is true of its points, each and in the order in which its decoder visits
// them.
struct SimulatedPacket {
  CapturedDatagram datagram;
  std::vector<PointTruth> points;
};

}  // namespace iog::tools
