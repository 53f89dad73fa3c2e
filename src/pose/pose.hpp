// The pose of the vehicle frame in the local frame. The local frame is planar, and the source's
// poses do not jump in it.
#pragma once

#include <cstdint>

namespace iog::pose {

struct Pose {
  std::int32_t x_mm = 0;  // position of the vehicle frame's origin
  std::int32_t y_mm = 0;
  std::uint32_t heading = 0;  // 2^-32 turns, counter-clockwise from the local frame's x
  friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

}  // namespace iog::pose
