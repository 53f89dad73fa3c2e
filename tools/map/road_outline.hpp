// The surface of a road: everything within half its width of its middle.
//
// It comes in pieces that overlap or touch: each is simple (its outline does not cross itself), for
// it turns by a quarter at most and its inner side has room to turn. Where the middle turns more
// sharply, or has no room, two pieces end in half circles.
#pragma once

#include <vector>

#include "tools/map/polygon.hpp"

namespace iog::tools {

struct RoadLine {
  std::vector<PlanePoint> middle{};
  double width_cm = 0;
  bool is_round_at_start = false;
  bool is_round_at_end = false;
};

// No piece is longer than this, nor much longer than this and its width its box.
inline constexpr double kMaxPieceCm = 15'000;

// Empty if the middle has no length.
[[nodiscard]] std::vector<Ring> outlines_of(const RoadLine& road);

}  // namespace iog::tools
