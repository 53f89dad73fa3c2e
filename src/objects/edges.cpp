// Ranges: places are within the window and a box, 2^18 mm. With at most 2^12 hits, sums are below
// 2^30.
#include "objects/edges.hpp"

#include <algorithm>
#include <limits>

#include "objects/rules.hpp"

namespace iog::objects {
namespace {

// Running sums for both ends of one side.
struct Sums {
  Interval outermost{std::numeric_limits<std::int32_t>::max(),
                     -std::numeric_limits<std::int32_t>::max()};
  Edge low{.hits = 0};  // relative to the outermost
  Edge high{.hits = 0};

  void add(std::int32_t place) {
    const std::int32_t from_low = place - outermost.low;
    const std::int32_t from_high = outermost.high - place;
    low.mm += from_low <= kSlabMm ? from_low : 0;
    low.hits += from_low <= kSlabMm ? 1 : 0;
    high.mm += from_high <= kSlabMm ? from_high : 0;
    high.hits += from_high <= kSlabMm ? 1 : 0;
  }
  [[nodiscard]] Ends ends() const {
    return {.low = {.mm = outermost.low + low.mm / low.hits, .hits = low.hits},
            .high = {.mm = outermost.high - high.mm / high.hits, .hits = high.hits}};
  }
};

}  // namespace

Edges edges_of(const Box& box, std::span<const std::uint16_t> numbers,
               std::span<const FrameHit> hits) {
  const auto for_each_place = [&](auto&& visit) {
    for (const std::uint16_t number : numbers) {
      if (const FrameHit& hit = hits[number]; !hit.stands) {
        visit(box.place(hit.moved, kAlong), box.place(hit.moved, kAcross));
      }
    }
  };
  Sums along;
  Sums across;
  for_each_place([&](std::int32_t a, std::int32_t b) {
    along.outermost.include(a);
    across.outermost.include(b);
  });
  if (along.outermost.low > along.outermost.high) {
    const auto own = [](const Interval& side) {
      return Ends{.low = {.mm = side.low}, .high = {.mm = side.high}};
    };
    return {own(box.sides[kAlong]), own(box.sides[kAcross])};
  }
  for_each_place([&](std::int32_t a, std::int32_t b) {
    along.add(a);
    across.add(b);
  });
  return {along.ends(), across.ends()};
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
