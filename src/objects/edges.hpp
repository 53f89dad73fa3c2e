// Computes the extent of a track's hits along and across the track's box.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/plane.hpp"

namespace iog::objects {

// The hits within kSlabMm of the outermost hit form an edge. Stores their mean position and their
// number.
struct Edge {
  std::int32_t mm = 0;  // from the reference point of the box
  std::int32_t hits = 1;
};
struct Ends {
  Edge low{};
  Edge high{};
};
using Edges = std::array<Ends, 2>;  // indexed by Side

// Returns the edges of the non-standing hits. If all hits are classified as standing, returns the
// edges of the box.
[[nodiscard]] Edges edges_of(const Box& box, std::span<const std::uint16_t> numbers,
                             std::span<const FrameHit> hits);

// Returns the intervals that a box with the given edges covers along its axes. The box is at least
// kThinnestMm thick.
[[nodiscard]] Sides sides_of(const Edges& edges);

}  // namespace iog::objects
