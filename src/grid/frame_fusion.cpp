#include "grid/frame_fusion.hpp"

#include <algorithm>
#include <optional>

#include "require/require.hpp"
#include "traversal/steady_walk.hpp"
#include "traversal/walk.hpp"

namespace iog::grid {
namespace {

using traversal::Position;
using traversal::Share;
using traversal::Stretch;
using vehicle::Beam;
using vehicle::BeamLine;
using vehicle::Sensor;

constexpr Share kWholeLine{1, 1};

// The cells of a line that lie in the grid, from its start to `last`. Most lines have both ends in
// the grid; then so is everything between them, and there is nothing to divide.
std::optional<WalkRange> inside_grid(const OpenLine& open, Position last) {
  const BeamLine& line = open.beam.line;
  if (open.starts_in_grid && vehicle::kGridArea.contains(line.cell(last))) {
    return WalkRange{{}, last.crossed() + 1};
  }
  const std::optional<Stretch> stretch = line.clip(vehicle::kGridArea);
  if (!stretch) {
    return std::nullopt;
  }
  return WalkRange{stretch->first, std::min(last.crossed(), stretch->last_crossed) + 1};
}

// Narrows a range to the part of the beam that is inside the height band. False if nothing is left.
bool narrow_to_band(const vehicle::Vehicle& vehicle, const Sensor& sensor, const Beam& beam,
                    std::uint32_t reach_mm, WalkRange& range) {
  const vehicle::BandPart part = vehicle::part_in_band(vehicle, sensor, beam, reach_mm);
  if (part.is_whole) {
    return true;
  }
  if (part.is_empty) {
    return false;
  }
  if (part.from.numerator > 0) {
    const Position first = beam.line.through(part.from);
    if (first.crossed() > range.first.crossed()) {
      range.first = first;
    }
  }
  range.end = std::min(range.end, beam.line.before(part.to).crossed() + 1);
  return range.first.crossed() < range.end;
}

}  // namespace

bool FrameFusion::fits(const Sensor& sensor, std::uint32_t points) const {
  const std::uint64_t needed = std::uint64_t{points} * max_marks_per_point(sensor);
  return needed <= kMaxMarks - mark_count_;
}

vehicle::Fate FrameFusion::add(const Sensor& sensor, const lidar::ScanPoint& point) {
  OpenLine& open = open_line(sensor, point);
  const vehicle::Judgement judgement = vehicle::judge(sensor, open.beam, point);
  const bool has_point = 0 < point.range_mm && point.range_mm <= sensor.range.mm();
  const Position hit = has_point ? open.through(point.range_mm) : Position{};
  if (judgement.carves) {
    if (const std::optional<WalkRange> range = range_to_carve(open, point, judgement, hit)) {
      carve_later(open, *range, point.range_mm);
    }
  }
  if (judgement.marks) {
    mark(open, hit, point.range_mm);
  }
  return judgement.fate;
}

// The place of a line is that of its layer: what waits there for another azimuth is carved now.
OpenLine& FrameFusion::open_line(const Sensor& sensor, const lidar::ScanPoint& point) {
  const vehicle::Layer& layer = sensor.layers[point.layer];
  OpenLine& open = open_lines_[layer.line];
  if (!open.is_of(sensor, point.azimuth_ticks)) {
    carve(open);
    open.aim(sensor, layer, point.azimuth_ticks);
  } else if (!open.steps.has_room()) {
    carve(open);
  }
  open.beam.end_z = vehicle::end_height_of(layer, open.direction);
  return open;
}

// Where a beam carves: before its scan point, or the whole line where that is too far. A beam
// without an echo carves up to where the sensor's description says.
std::optional<WalkRange> FrameFusion::range_to_carve(const OpenLine& open,
                                                     const lidar::ScanPoint& point,
                                                     const vehicle::Judgement& judgement,
                                                     Position hit) const {
  const BeamLine& line = open.beam.line;
  const std::uint32_t length_mm = open.sensor->range.mm();
  const bool has_echo = point.range_mm > 0;
  const std::uint32_t reach_mm =
      has_echo ? std::min(point.range_mm, length_mm) : open.sensor->no_return_clears_mm;
  const bool ends_at_hit = has_echo && point.range_mm <= length_mm;
  const Position last = ends_at_hit ? hit : line.before({reach_mm, length_mm});
  std::optional<WalkRange> range = inside_grid(open, last);
  if (!range) {
    return std::nullopt;
  }
  if (!judgement.is_whole_in_band &&
      !narrow_to_band(*vehicle_, *open.sensor, open.beam, reach_mm, *range)) {
    return std::nullopt;
  }
  if (ends_at_hit) {
    range->end = std::min(range->end, hit.crossed());
  }
  return range->first.crossed() < range->end ? range : std::nullopt;
}

// Cells before the scan point take the index of the 1D cell in which the line leaves them. The line
// leaves a cell within 1D cell j or earlier exactly if its border there is crossed at (j + 1) Delta
// or before: `through` counts those crossings, and so says where each zone of the profile ends.
void FrameFusion::carve_later(OpenLine& open, const WalkRange& range, std::uint32_t range_mm) {
  const sensor_model::Profile& profile = open.sensor->profile;
  std::uint32_t at = range.first.crossed();
  std::int32_t free_before = 0;
  const auto carve_until = [&](std::uint32_t end, OccupancyIndex index) {
    const std::uint32_t stop = std::min(end, range.end);
    if (at < stop) {
      open.steps.add({at, -index - free_before});
      free_before = -index;
      at = stop;
    }
  };

  open.steps.begin(range.first);
  const std::uint32_t k = open.sensor->precision.divide(range_mm);
  const bool has_echo = range_mm > 0;
  for (std::uint32_t back = has_echo ? profile.near_before_count : 0; back > 0; --back) {
    // 1D cells before k - back, which end at (k - back) Delta.
    if (k >= back) {
      const OccupancyIndex index =
          back == profile.near_before_count ? profile.free : profile.near_before[back];
      carve_until(open.through((k - back) * open.sensor->precision_mm).crossed(), index);
    }
  }
  const bool ends_near = has_echo && profile.near_before_count > 0;
  carve_until(range.end, ends_near ? profile.near_before[0] : profile.free);
  open.steps.add({at, -free_before});
}

void FrameFusion::carve_waiting() {
  for (OpenLine& open : open_lines_) {
    carve(open);
    open.sensor = nullptr;
  }
}

void FrameFusion::carve(OpenLine& open) {
  if (open.steps.empty()) {
    return;
  }
  const BeamLine& line = open.beam.line;
  const Position first = open.steps.first();
  std::int32_t index = 0;
  const auto carve_cell = [&](OccupancyIndex& cell) { cell = index::sat_lower(cell, index); };
  if (traversal::may_meet_corner(line)) {
    traversal::Walk walk(line, first, kStride);
    for (const FreeSteps::Change& change : open.steps.changes()) {
      walk.until(change.crossed, [&](std::size_t offset) { carve_cell(cells_[offset]); });
      index -= change.freer;
    }
  } else {
    traversal::SteadyWalk walk(line, first, cells_.data(), kStride);
    std::uint32_t at = first.crossed();
    for (const FreeSteps::Change& change : open.steps.changes()) {
      walk.visit(change.crossed - at, carve_cell);
      at = change.crossed;
      index -= change.freer;
    }
  }
  open.steps.clear();
}

// One hit marks one cell: the one that holds the scan point.
void FrameFusion::mark(const OpenLine& open, Position hit, std::uint32_t range_mm) {
  const sensor_model::Profile& profile = open.sensor->profile;
  const BeamLine& line = open.beam.line;
  const traversal::Cell cell = line.cell(hit);
  if (vehicle::kGridArea.contains(cell)) {
    const std::int32_t offset = cell.y * kStride + cell.x;
    remember(static_cast<std::size_t>(offset), profile.hit);
  }
  if (profile.near_after_count > 0) {
    const std::optional<Stretch> inside = line.clip(vehicle::kGridArea);
    if (inside) {
      mark_behind(*open.sensor, line, *inside, hit, range_mm);
    }
  }
}

// Cells behind the scan point take the index of the 1D cell in which the line enters them, at least
// k + 1. The line enters a cell within 1D cell j or earlier exactly if its border there is crossed
// before (j + 1) Delta: `before` counts those crossings.
void FrameFusion::mark_behind(const Sensor& sensor, const BeamLine& line, const Stretch& inside,
                              Position hit, std::uint32_t range_mm) {
  const std::uint32_t k = sensor.precision.divide(range_mm);
  const std::uint32_t line_end =
      std::min(line.before(kWholeLine).crossed(), inside.last_crossed) + 1;
  const bool from_hit = hit.crossed() >= inside.first.crossed();
  traversal::Walk walk(line, from_hit ? hit : inside.first, kStride);
  if (from_hit) {
    walk.skip_until(std::min(hit.crossed() + 1, line_end));
  }
  for (std::uint32_t j = 0; j < sensor.profile.near_after_count; ++j) {
    const Share far_end{std::uint64_t{k + 2 + j} * sensor.precision_mm, sensor.range.mm()};
    const std::uint32_t end = std::min(line.before(far_end).crossed() + 1, line_end);
    const OccupancyIndex index = sensor.profile.near_after[j];
    if (index == 0) {
      walk.skip_until(end);
    } else {
      walk.until(end, [&](std::size_t offset) { remember(offset, index); });
    }
  }
}

void FrameFusion::remember(std::size_t offset, OccupancyIndex index) {
  require(mark_count_ < kMaxMarks);
  marks_[mark_count_] = {static_cast<std::uint32_t>(offset) & 0xFFFFFFU, index};
  ++mark_count_;
}

// hits_win: evidence for a cell is its marks alone where it has any, so the first mark erases what
// was carved: max(cell, 0) + index. bayes: the marks are added to it.
void FrameFusion::finish() {
  carve_waiting();
  const bool hits_win = vehicle_->rule == vehicle::FusionRule::kHitsWin;
  for (const Mark& mark : std::span(marks_).first(mark_count_)) {
    OccupancyIndex& cell = cells_[mark.offset];
    const OccupancyIndex before = hits_win ? std::max(cell, index::kUnknown) : cell;
    cell = index::sat_add(before, static_cast<OccupancyIndex>(mark.index));
  }
  mark_count_ = 0;
}

void FrameFusion::clear() {
  for (OpenLine& open : open_lines_) {
    open.steps.clear();
  }
  cells_.fill(index::kUnknown);
  mark_count_ = 0;
}

}  // namespace iog::grid
