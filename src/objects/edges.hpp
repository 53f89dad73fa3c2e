// Where the hits of a track end, along and across its box.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "objects/hit.hpp"
#include "objects/plane.hpp"

namespace iog::objects {

// The mean of the hits within kSlabMm of the outermost, and how many they are.
struct Edge {
  std::int32_t mm = 0;  // from the box's point
  std::int32_t hits = 1;
};
struct Ends {
  Edge low{};
  Edge high{};
};
using Edges = std::array<Ends, 2>;  // by Side

// Of hits, some of which may stand: those do not count. If none counts, the box's own.
[[nodiscard]] Edges edges_of(const Box& box, std::span<const std::uint16_t> numbers,
                             std::span<const FrameHit> hits);

// The sides of a box that ends there, kThinnestMm thick at least.
[[nodiscard]] Sides sides_of(const Edges& edges);

}  // namespace iog::objects
