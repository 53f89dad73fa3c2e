#include "tools/simulate/truth/true_ground.hpp"

#include <algorithm>
#include <utility>

#include "geometry/grid.hpp"

namespace iog::tools {
namespace {

constexpr double kBucketM = 8.0;

}  // namespace

TrueGround::TrueGround(const SitePlan& plan) {
  for (const PlannedRoad& road : plan.roads) {
    add_road(road);
  }
  for (const PlannedHouse& house : plan.houses) {
    const auto corner = [&house](double forward, double left) {
      const Placement at =
          moved(house.at, forward * house.half_length_m, left * house.half_width_m);
      return Corner{at.x, at.y};
    };
    add({{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, Ground::kHouse});
  }
  sort_into_buckets();
}

bool TrueGround::Shape::covers(double x, double y) const {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& from = corners[i];
    const Corner& to = corners[(i + 1) % corners.size()];
    if ((to.x - from.x) * (y - from.y) - (to.y - from.y) * (x - from.x) < 0) {
      return false;
    }
  }
  return true;
}

TrueGround::Box TrueGround::box_of(const Shape& shape) {
  const auto [low_x, high_x] = std::ranges::minmax(shape.corners, {}, &Corner::x);
  const auto [low_y, high_y] = std::ranges::minmax(shape.corners, {}, &Corner::y);
  return {low_x.x, low_y.y, high_x.x, high_y.y};
}

// A line may be driven against the way its placements point.
void TrueGround::add_road(const PlannedRoad& road) {
  const double half = road.width_m / 2;
  for (std::size_t i = 0; i + 1 < road.line.size(); ++i) {
    const Placement* from = &road.line[i];
    const Placement* to = &road.line[i + 1];
    if ((to->x - from->x) * from->cos + (to->y - from->y) * from->sin < 0) {
      std::swap(from, to);
    }
    const auto corner = [](const Placement& at, double left) {
      const Placement edge = moved(at, 0, left);
      return Corner{edge.x, edge.y};
    };
    add({{corner(*from, -half), corner(*to, -half), corner(*to, half), corner(*from, half)},
         Ground::kRoad});
  }
}

void TrueGround::sort_into_buckets() {
  if (shapes_.empty()) {
    return;
  }
  extent_ = box_of(shapes_.front());
  for (const Shape& shape : shapes_) {
    const Box box = box_of(shape);
    extent_ = {std::min(extent_.low_x, box.low_x), std::min(extent_.low_y, box.low_y),
               std::max(extent_.high_x, box.high_x), std::max(extent_.high_y, box.high_y)};
  }
  columns_ = column_of(extent_.high_x) + 1;
  buckets_.resize(columns_ * (row_of(extent_.high_y) + 1));
  for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
    const Box box = box_of(shapes_[i]);
    for (std::size_t row = row_of(box.low_y); row <= row_of(box.high_y); ++row) {
      for (std::size_t column = column_of(box.low_x); column <= column_of(box.high_x); ++column) {
        buckets_[row * columns_ + column].push_back(i);
      }
    }
  }
}

std::size_t TrueGround::column_of(double x) const {
  return static_cast<std::size_t>((x - extent_.low_x) / kBucketM);
}

std::size_t TrueGround::row_of(double y) const {
  return static_cast<std::size_t>((y - extent_.low_y) / kBucketM);
}

Ground TrueGround::at(double x, double y) const {
  const bool is_known = !shapes_.empty() && x >= extent_.low_x && x <= extent_.high_x &&
                        y >= extent_.low_y && y <= extent_.high_y;
  if (!is_known) {
    return Ground::kBeside;
  }
  Ground ground = Ground::kBeside;
  for (const std::uint32_t i : buckets_[row_of(y) * columns_ + column_of(x)]) {
    if (shapes_[i].ground > ground && shapes_[i].covers(x, y)) {
      ground = shapes_[i].ground;
    }
  }
  return ground;
}

std::vector<Ground> true_ground(const TrueGround& ground, const CellArea& area) {
  std::vector<Ground> cells;
  cells.reserve(static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height));
  for (std::int32_t y = area.y; y < area.y + area.height; ++y) {
    for (std::int32_t x = area.x; x < area.x + area.width; ++x) {
      cells.push_back(ground.at((x + 0.5) * area.cell_m, (y + 0.5) * area.cell_m));
    }
  }
  return cells;
}

}  // namespace iog::tools
