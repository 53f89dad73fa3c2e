// A hit of a frame: what was hit in a cell in one of its slices.
#pragma once

#include <cstdint>

#include "geometry/cell.hpp"

namespace iog::placing {

struct Hit {
  geometry::Cell cell{};   // of the local frame
  std::uint8_t slice = 0;  // its number in the frame
  friend constexpr bool operator==(const Hit&, const Hit&) = default;
};

}  // namespace iog::placing
