// Turns walked to a surface, for the tests of ground/surface_walk.hpp.
#pragma once

#include <cstdint>

#include "fakes/ground_turns.hpp"
#include "ground/surface_walk.hpp"

namespace iog::tests {

inline constexpr ground::Bins kShort(50'000);
inline constexpr ground::Bins kLong(120'000);

[[nodiscard]] inline ground::Lows lows_of(ground::Bins bins, const Turn& turn) {
  ground::Lows lows;
  for (const Return& its : turn) {
    lows.add(bins, static_cast<std::uint32_t>(its.sector), static_cast<std::uint32_t>(its.along_mm),
             its.z_mm);
  }
  return lows;
}

[[nodiscard]] inline ground::Surface surface_after(ground::Bins bins, const Turn& turn) {
  ground::SurfaceWalk walk;
  ground::Surface surface;
  walk.close_turn(bins, lows_of(bins, turn), surface);
  return surface;
}

}  // namespace iog::tests
