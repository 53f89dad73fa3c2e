// Ranges. Places are within the window and a box, 2^18 mm, and hits are at most 2^12: sums are
// below 2^30.
#include "objects/edges.hpp"

#include <algorithm>
#include <limits>

#include "objects/rules.hpp"

namespace iog::objects {
namespace {

Ends ends_of(const Box& box, Side side, std::span<const std::uint16_t> numbers,
             std::span<const FrameHit> hits) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  Interval outermost{kMost, -kMost};
  for (const std::uint16_t number : numbers) {
    if (const FrameHit& hit = hits[number]; !hit.stands) {
      outermost.include(box.place(hit.moved, side));
    }
  }
  if (outermost.low > outermost.high) {
    return {{.mm = box.sides[side].low}, {.mm = box.sides[side].high}};
  }
  Edge low{.hits = 0};
  Edge high{.hits = 0};
  for (const std::uint16_t number : numbers) {
    if (const FrameHit& hit = hits[number]; !hit.stands) {
      const std::int32_t its = box.place(hit.moved, side);
      const bool is_low = its - outermost.low <= kSlabMm;
      const bool is_high = outermost.high - its <= kSlabMm;
      low.mm += is_low ? its - outermost.low : 0;
      low.hits += is_low ? 1 : 0;
      high.mm += is_high ? outermost.high - its : 0;
      high.hits += is_high ? 1 : 0;
    }
  }
  low.mm = outermost.low + low.mm / low.hits;
  high.mm = outermost.high - high.mm / high.hits;
  return {low, high};
}

}  // namespace

Edges edges_of(const Box& box, std::span<const std::uint16_t> numbers,
               std::span<const FrameHit> hits) {
  return {ends_of(box, kAlong, numbers, hits), ends_of(box, kAcross, numbers, hits)};
}

Sides sides_of(const Edges& edges) {
  Sides sides;
  for (const Side side : kSides) {
    sides[side].low = edges[side].low.mm;
    sides[side].high = std::max(edges[side].high.mm, edges[side].low.mm + kThinnestMm);
  }
  return sides;
}

}  // namespace iog::objects
