#include "grid/pending_marks.hpp"

#include <algorithm>

#include "traversal/walk.hpp"

namespace iog::grid {

// A cell behind the point takes the index of the 1D cell in which the line enters it, at least k +
// 1. The line enters a cell in 1D cell j or earlier exactly if it crosses the cell's near border
// before distance (j + 1) Delta. `before` counts those crossings.
void PendingMarks::mark_behind(const vehicle::Sensor& sensor, const KeptLine& line,
                               traversal::Position hit, std::uint32_t range_mm, bool is_tall) {
  const sensor_model::Profile& profile = sensor.profile;
  const std::uint32_t k = sensor.precision.divide(range_mm);
  const traversal::Position first = line.in_grid().first.at();
  const std::uint32_t line_end = line.in_grid().end.crossed();
  const bool from_hit = hit.crossed() >= first.crossed();
  traversal::Walk walk(line.line(), from_hit ? hit : first, geometry::kLongestSide);
  if (from_hit) {
    walk.skip_until(std::min(hit.crossed() + 1, line_end));
  }
  for (std::uint32_t j = 0; j < profile.near_after_count; ++j) {
    const traversal::Share far_end{std::uint64_t{k + 2 + j} * sensor.precision_mm,
                                   sensor.range.mm()};
    const std::uint32_t end = std::min(line.line().before(far_end).crossed() + 1, line_end);
    const OccupancyIndex index = profile.near_after[j];
    if (index == 0) {
      walk.skip_until(end);
    } else {
      walk.until(end, [&](std::size_t number) {
        remember(geometry::cell_of(number, geometry::kLongestSide), index, is_tall);
      });
    }
  }
}

// hits_win: if a cell has marks, only they are its evidence. So the first mark erases the carved
// index: max(cell, 0) + index. bayes: marks are added to the carved index.
void PendingMarks::apply(FrameGrids& grids, vehicle::FusionRule rule) {
  if (grids.keep_heights) {
    apply<true>(grids, rule);
  } else {
    apply<false>(grids, rule);
  }
  count_ = 0;
}

template <bool kWithHeights>
void PendingMarks::apply(FrameGrids& grids, vehicle::FusionRule rule) const {
  const OccupancyIndex least =
      rule == vehicle::FusionRule::kHitsWin ? index::kUnknown : index::kIndexMin<OccupancyIndex>;
  const std::int32_t stride = grids.indexes.stride();
  const std::uint32_t across = grids.indexes.tiles_across();
  for (const Mark& mark : std::span(marks_).first(count_)) {
    const geometry::Cell cell = geometry::cell_of(mark.cell, geometry::kLongestSide);
    const std::uint32_t offset = offset_of(cell, stride);
    const std::size_t tile = geometry::tile_of(cell, across);
    OccupancyIndex& index = grids.indexes.cell_at(offset);
    index = index::sat_add(std::max(index, least), static_cast<OccupancyIndex>(mark.index));
    grids.indexes.touch(tile);
    if constexpr (kWithHeights) {
      OccupancyIndex& height = grids.heights.cell_at(offset);
      height = std::max(height, static_cast<OccupancyIndex>(mark.is_tall));
      grids.heights.touch(tile);
    }
  }
}

}  // namespace iog::grid
