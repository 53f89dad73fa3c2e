// Ground by both implementations, and what a return is by its height over it (docs/ground.md).
#pragma once

#include <cstddef>
#include <cstdint>

#include "fakes/ground_car.hpp"
#include "fakes/ground_turns.hpp"
#include "fakes/reference_ground.hpp"
#include "ground/ground.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tests {

inline constexpr vehicle::GroundLimits kLimits{.low_mm = 220, .top_mm = 2'200};

// A turn's lowest returns and the surface made of them, by both implementations.
struct Surfaces {
  Surfaces(const vehicle::Vehicle& car, std::size_t sensor, const Turn& turn)
      : grounds(car), reference(ground_of(grounds, sensor).beams().bins().length_mm()) {
    ground::Lows lows;
    for (const Return& its : turn) {
      lows.add(ground_of(grounds, sensor).beams().bins(), static_cast<std::uint32_t>(its.sector),
               static_cast<std::uint32_t>(its.along_mm), its.z_mm);
      reference.see(its.sector, its.along_mm, its.z_mm);
    }
    grounds.close_turn(sensor, lows);
    reference.close_turn();
  }

  ground::Grounds grounds;
  ReferenceGround reference;
};

inline vehicle::Fate fate_at(Whole height_mm) {
  if (height_mm < -400) {
    return vehicle::Fate::kUnderGround;
  }
  if (height_mm < kLimits.low_mm) {
    return vehicle::Fate::kGround;
  }
  return height_mm > kLimits.top_mm ? vehicle::Fate::kOverhang : vehicle::Fate::kUsed;
}

}  // namespace iog::tests
