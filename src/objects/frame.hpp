// The input of the tracker for one frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "window/area.hpp"

namespace iog::objects {

// The maximum number of slices in a frame.
inline constexpr std::size_t kMostSlices = 32;

struct Frame {
  std::uint64_t end_us = 0;  // the middle of the last slice, on the clock of the poses
  Point car{};               // position of the car at that time
  std::int32_t blind_mm =
      0;                // around it, no beam is low enough to open cells (perception/rules.hpp)
  window::Area area{};  // position of the window
  // For each slice, the time from its middle to the end of the frame, in the range 0 to 255 ms. The
  // span has at most kMostSlices entries.
  std::span<const std::uint8_t> ages_ms{};
  // The hits of the frame, in any order. Duplicate hits are counted only once.
  std::span<const Hit> hits{};
};

}  // namespace iog::objects
