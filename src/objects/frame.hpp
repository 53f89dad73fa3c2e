// What a frame says to those who look for things in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "window/area.hpp"

namespace iog::objects {

// Slices of a frame.
inline constexpr std::size_t kMostSlices = 32;

struct Frame {
  std::uint64_t end_us = 0;  // the middle of its last slice, by the clock of the poses
  Point car{};               // where the car was then
  window::Area area{};       // where the window lies
  // By slice from its middle to the frame's end, 0 ... 255 ms. Not more than kMostSlices.
  std::span<const std::uint8_t> ages_ms{};
  // In any order. Hits that are said twice count once.
  std::span<const Hit> hits{};
};

}  // namespace iog::objects
