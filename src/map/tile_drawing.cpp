#include "map/tile_drawing.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "map/blur.hpp"

namespace iog::map {

TileDrawing::TileDrawing(const Block& block, const TilePlace& place, std::int32_t radius)
    : place_(place), radius_(radius), extent_(block.extent()), features_(block, place.box(radius)) {
  const BoxCm box = place.box(radius);
  is_inside_ = extent_.holds(box.low) && extent_.holds(box.high);
  raster_.clear(RowRange::around_tile(radius));
}

bool TileDrawing::go_on(std::uint32_t& budget) {
  while (budget > 0) {
    if (edges_) {
      take_edges(budget);
    } else if (features_.is_over()) {
      return true;
    } else {
      --budget;
      const std::optional<Feature> found = features_.look();
      if (found && raster_.reaches(place_.fine_box(found->box()))) {
        edges_.emplace(*found);
        kind_ = found->kind();
      }
    }
  }
  return !edges_ && features_.is_over();
}

void TileDrawing::take_edges(std::uint32_t& budget) {
  EdgeWalk edges = *edges_;
  std::uint32_t left = budget;
  PointCm last{};
  FinePoint last_fine = place_.fine(last);
  while (left > 0 && !edges.is_over()) {
    const auto [from, to] = edges.next();
    const FinePoint from_fine = last == from ? last_fine : place_.fine(from);
    last = to;
    last_fine = place_.fine(to);
    const RowRange rows = raster_.crossed(from_fine.y, last_fine.y);
    left -= std::min(left, rows.is_empty() ? 1 : kWorkPerCrossing);
    if (!rows.is_empty()) {
      raster_.add_edge(rows, from_fine, last_fine);
    }
  }
  budget = left;
  edges_ = edges;
  if (edges.is_over()) {
    raster_.add_to(kind_ == Kind::kBuilding ? buildings_ : roads_);
    edges_.reset();
  }
}

// The cells whose centre is outside the extent.
FrameBits TileDrawing::outside() {
  FrameBits bits;
  if (is_inside_) {
    return bits;
  }
  const FinePoint a = place_.fine(extent_.low);
  const FinePoint b = place_.fine({extent_.high.x, extent_.low.y});
  const FinePoint c = place_.fine(extent_.high);
  const FinePoint d = place_.fine({extent_.low.x, extent_.high.y});
  for (const auto& [from, to] :
       {std::pair(a, b), std::pair(b, c), std::pair(c, d), std::pair(d, a)}) {
    if (const RowRange rows = raster_.crossed(from.y, to.y); !rows.is_empty()) {
      raster_.add_edge(rows, from, to);
    }
  }
  raster_.add_to(bits);
  for (std::uint64_t& row : bits.rows) {
    row = ~row;
  }
  return bits;
}

TileMask TileDrawing::mask() {
  const FrameBits anything = outside();
  FrameBits intermediate;
  for (std::size_t y = 0; y < intermediate.rows.size(); ++y) {
    intermediate.rows[y] = ~(buildings_.rows[y] | roads_.rows[y]) | anything.rows[y];
    buildings_.rows[y] |= anything.rows[y];
    roads_.rows[y] |= anything.rows[y];
  }
  return {.building = blurred(buildings_, radius_),
          .road = blurred(roads_, radius_),
          .intermediate = blurred(intermediate, radius_)};
}

}  // namespace iog::map
