// Classifies a return by its height above the ground.
#pragma once

#include <cstdint>

namespace iog::ground {

// A return at a height from low_mm to top_mm above the ground is an obstacle. Both limits are
// inclusive.
struct Limits {
  std::int32_t low_mm = 220;
  std::int32_t top_mm = 2'200;
};

// A return more than kUnderMm below the surface is a mirror image, a hole or a drop.
inline constexpr std::int32_t kUnderMm = 400;

enum class Kind : std::uint8_t {
  kGround,
  kObstacle,
  kOverhang,  // high enough above the ground that the car can drive under it
  kUnder,     // below the surface by more than kUnderMm
};

[[nodiscard]] constexpr Kind judge(Limits limits, std::int32_t height_mm) {
  if (height_mm < limits.low_mm) {
    return height_mm < -kUnderMm ? Kind::kUnder : Kind::kGround;
  }
  return height_mm > limits.top_mm ? Kind::kOverhang : Kind::kObstacle;
}

}  // namespace iog::ground
