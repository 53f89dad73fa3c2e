#include "grid/carver.hpp"

#include <algorithm>
#include <bit>

#include "grid/carving.hpp"

namespace iog::grid {

using traversal::Position;
using vehicle::Sensor;

Carver::Carver(const vehicle::Vehicle& vehicle, BlockGrid& grid, PendingMarks& marks)
    : turn_lines_(vehicle),
      lines_(vehicle.sensors),
      vehicle_(&vehicle),
      grid_(&grid),
      marks_(&marks) {}

void Carver::begin_turning(const Sensor& sensor) {
  carve_waiting();
  sensor_ = &sensor;
  kept_ = nullptr;
  turn_layers_at_hand_ = &turn_lines_.layers_of(sensor);
}

// Another line in its place is carved and makes room.
void Carver::begin_line(std::uint32_t azimuth_step) {
  waiting_lines_.take(azimuth_step, [&](auto&&... line) { carve_turn(line...); });
  waiting_lines_.begin(azimuth_step, turn_lines_.on_car(*sensor_, azimuth_step));
}

// A point that is not a millimetre away has nothing before it to carve.
void Carver::mark_at_start(std::uint32_t azimuth_step) {
  const KeptLine& line = turn_lines_.line(*sensor_, azimuth_step);
  marks_->mark(*sensor_, line, line.through(*sensor_, 0), 0);
}

void Carver::turn_to(const Sensor& sensor, std::uint16_t azimuth_ticks) {
  carve_waiting();
  turn_layers_at_hand_ = nullptr;
  sensor_ = &sensor;
  azimuth_ticks_ = azimuth_ticks;
  further_found_ = 0;
  azimuth_step_ = sensor.azimuths.nearest(azimuth_ticks);
  kept_ = &lines_.azimuth(sensor, azimuth_step_);
}

// Beams beyond what a KeptAzimuth keeps are found for each point.
KeptBeam& Carver::find_beam(std::uint8_t layer) {
  const vehicle::Layer& its = sensor_->layers[layer];
  if (its.line < KeptAzimuth::kMaxLines) {
    if (layer < KeptAzimuth::kMaxLayers) {
      return kept_->find_beam(*sensor_, layer);
    }
    further_beam_.find(*sensor_, its, azimuth_step_, kept_->line_of(*sensor_, its));
    return further_beam_;
  }
  further_beam_.find(*sensor_, its, azimuth_step_, further_line(its));
  return further_beam_;
}

// Beams that wait for another line in its place are carved before.
KeptLine& Carver::further_line(const vehicle::Layer& layer) {
  const std::uint32_t place = place_of(layer.line);
  FurtherLine& further = further_lines_[place];
  if ((further_found_ >> place & 1U) == 0 || further.number != layer.line) {
    carve_place(place);
    further_found_ |= 1U << place;
    further.number = layer.line;
    further.line.find(*sensor_, layer, azimuth_step_);
  }
  return further.line;
}

// Adds a beam to the steps of its line. A cell before the scan point * takes the index of the 1D
// cell in which the line leaves it, at most k - 1. For a LUX:
//
//    1D cells      k - 3   |   k - 2   |   k - 1   |     k     |
//    the line  S ----------+-----------+-----------+-------*---+-------> E
//    its cells     a   |   b    |  c  |    d    |   e   |    f     |
//    freer by      14      7       7       0        0     marked, not carved
//    steps     +14       -7 at b         -7 at d
//
// The line leaves a cell in 1D cell j or earlier exactly if it crosses the cell's far border at
// distance (j + 1) Delta or before. `through` counts those crossings. So the zone of 1D cell k - 2
// begins in the cell that holds the point at (k - 2) Delta, here b.
inline void Carver::carve_later(FreeSteps& steps, const KeptLine& line, const LinePart& part,
                                std::uint32_t range_mm) const {
  steps.begin_beam(part.first, -sensor_->profile.free);
  add_zones(steps, line, part, range_mm);
  steps.end_beam(part.end);
}

// The changes behind the beginning.
inline void Carver::add_zones(FreeSteps& steps, const KeptLine& line, const LinePart& part,
                              std::uint32_t range_mm) const {
  const sensor_model::Profile& profile = sensor_->profile;
  std::int32_t freer = -profile.free;
  const std::uint32_t k = sensor_->precision.divide(range_mm);
  const std::uint32_t delta_mm = sensor_->precision_mm;
  const std::uint32_t zones = range_mm > 0 ? profile.near_before_count : 0;
  std::uint32_t begin_mm = (k - zones) * delta_mm;
  for (std::uint32_t back = zones; back > 0; --back, begin_mm += delta_mm) {
    // 1D cells from k - back on, which begin at (k - back) Delta.
    const Between zone = k < back ? part.first : Between::before(line.through(*sensor_, begin_mm));
    const std::int32_t in_zone = -profile.near_before[back - 1];
    steps.add(std::clamp(zone, part.first, part.end), in_zone - freer);
    freer = in_zone;
  }
  if (freer != 0) {
    steps.add(part.end, -freer);
  }
}

// Carves and marks as its fate says.
template <typename Beam>
inline void Carver::take(Beam&& beam, vehicle::Classification its, std::uint32_t range_mm) {
  const KeptLine& line = beam.line();
  const bool leaves_band = its.carves && !its.is_whole_in_band;
  const LinePart limits = leaves_band ? beam.in_band(*vehicle_, *sensor_) : line.in_grid();
  if (leaves_band && range_mm >= beam.is_free_before_mm()) {
    if (!limits.is_empty()) {
      const std::int32_t freer = -sensor_->profile.free;
      auto& steps = steps_of(beam, limits.end);
      steps.begin_beam(limits.first, freer);
      steps.add(limits.end, -freer);
      steps.end_beam(limits.end);
    }
    return;
  }
  const bool has_hit = range_mm - 1 < sensor_->range.mm();
  const Position hit = has_hit ? line.through(*sensor_, range_mm) : Position{};
  if (its.carves) {
    const Between end =
        has_hit ? Between::before(hit) : end_without_hit(line, beam.clears_mm(), range_mm);
    const LinePart part{limits.first, std::min(limits.end, end)};
    if (!part.is_empty()) {
      carve_later(steps_of(beam, part.end), line, part, range_mm);
    }
  }
  if (its.marks) {
    marks_->mark(*sensor_, line, hit, range_mm);
  }
}

void Carver::take_kept(KeptBeam& beam, vehicle::Classification its, std::uint32_t range_mm) {
  take(beam, its, range_mm);
}

// The end of a beam whose echo lies beyond the line: the line's. Without an echo it carves as far
// as the sensor's description says.
Between Carver::end_without_hit(const KeptLine& line, std::uint32_t clears_mm,
                                std::uint32_t range_mm) const {
  const std::uint32_t length_mm = sensor_->range.mm();
  return range_mm == 0 && clears_mm < length_mm
             ? Between::after(line.line().before({clears_mm, length_mm}))
             : line.in_grid().end;
}

// Where a beam waits to be carved. If it goes through the same cells as the first line up to its
// end, it waits with the beams of the first line.
inline FreeSteps& Carver::steps_of(const KeptBeam& beam, Between end) {
  const bool shares = beam.line_number() == 1 && kept_->is_common(end.at().crossed() + 1);
  return shares ? steps_on(0, kept_->first_line()) : steps_on(beam.line_number(), beam.line());
}

// Another line in the place is carved and makes room.
inline FreeSteps& Carver::steps_on(std::uint32_t number, KeptLine& line) {
  const std::uint32_t place = place_of(number);
  OpenLine& open = open_lines_[place];
  if (open.line != &line) {
    carve_place(place);
    lines_in_use_ |= 1U << place;
    open.line = &line;
    open.steps.begin_at(line.in_grid().first);
  } else if (!open.steps.has_room()) {
    carve(open);
  }
  return open.steps;
}

void Carver::carve_place(std::uint32_t place) {
  if ((lines_in_use_ >> place & 1U) != 0) {
    carve(open_lines_[place]);
    open_lines_[place].line = nullptr;
    lines_in_use_ &= ~(1U << place);
  }
}

void Carver::carve_waiting() {
  while (lines_in_use_ != 0) {
    carve_place(static_cast<std::uint32_t>(std::countr_zero(lines_in_use_)));
  }
  if (turn_layers_at_hand_ != nullptr) {
    waiting_lines_.take_all([&](auto&&... line) { carve_turn(line...); });
  }
}

// Only one such line is carved at a time: it takes the steps of a line of which none waits.
void Carver::carve_turn(std::uint32_t azimuth_step, std::span<const WaitingPoint> points,
                        const RankSet& behind_band) {
  KeptLine& line = turn_lines_.line(*sensor_, azimuth_step);
  FreeSteps& steps = open_lines_[0].steps;
  steps.begin_at(line.in_grid().first);
  const std::uint32_t far_hits = take_points(steps, line, points);
  take_behind_band(steps, line, behind_band, far_hits);
  if (!steps.is_empty()) {
    carve(line, steps);
  }
}

// Returns how many of them are hits at TurnLayers::far_mm or beyond. Nearly all are hits, whose
// beams are in the band from the start.
std::uint32_t Carver::take_points(FreeSteps& steps, const KeptLine& line,
                                  std::span<const WaitingPoint> points) {
  const TurnLayers& turn = *turn_layers_at_hand_;
  const LinePart in_grid = line.in_grid();
  std::uint32_t beams = 0;
  std::uint32_t far_hits = 0;
  Between last = in_grid.first;
  for (const WaitingPoint point : points) {
    if (point.fate() != vehicle::Fate::kUsed || !turn.start_in_band) {
      take_rare(line, point);
      continue;
    }
    const std::uint32_t range_mm = point.along_mm();
    const Position hit = line.through(*sensor_, range_mm);
    const LinePart part{in_grid.first, std::min(in_grid.end, Between::before(hit))};
    if (!part.is_empty()) {
      add_zones(steps, line, part, range_mm);
      last = std::max(last, part.end);
      ++beams;
      far_hits += range_mm >= turn.far_mm ? 1U : 0U;
    }
    marks_->mark(*sensor_, line, hit, range_mm);
  }
  steps.add_beams(beams, -sensor_->profile.free, last);
  return far_hits;
}

// What a beam frees, those of lower rank free, too, and from some rank on so do far hits. After
// enough of them it adds nothing, and neither does one of higher rank.
void Carver::take_behind_band(FreeSteps& steps, const KeptLine& line, const RankSet& ranks,
                              std::uint32_t far_hits) const {
  const TurnLayers& turn = *turn_layers_at_hand_;
  const std::int32_t freer = -sensor_->profile.free;
  std::uint32_t beams = 0;
  Between last = line.in_grid().first;
  ranks.visit_while([&](std::uint32_t rank) {
    if (beams + (rank < turn.near_rank ? 0 : far_hits) >= turn.enough_beams) {
      return false;
    }
    const Between end = line.end_in_band(turn.layers[turn.by_rank[rank]].band);
    steps.add(end, -freer);
    last = std::max(last, end);
    ++beams;
    return true;
  });
  steps.add_beams(beams, freer, last);
}

// What is no hit with all of its beam in the band, and carves or marks nevertheless.
void Carver::take_rare(const KeptLine& line, WaitingPoint point) {
  const TurnLayer& layer = turn_layers_at_hand_->layers[point.layer()];
  const std::uint32_t reach_mm = std::min(point.along_mm(), sensor_->range.mm());
  take(TurnBeam(line, layer),
       {.fate = point.fate(),
        .carves = point.carves(),
        .marks = point.marks(),
        .is_whole_in_band =
            reach_mm > 0 && layer.in_band.first == 0 && layer.in_band.contain(reach_mm)},
       point.along_mm());
}

void Carver::carve(KeptLine& line, FreeSteps& steps) {
  if (line.has_path()) {
    carve_blocks(*grid_, line.path(), steps);
  } else {
    carve_cells(*grid_, line.line(), line.in_grid().first.at(), steps);
  }
}

void Carver::drop_waiting() {
  for (OpenLine& open : open_lines_) {
    open.steps.take_changes([](Between /*point*/, std::int32_t /*freer*/) {});
    open.line = nullptr;
  }
  lines_in_use_ = 0;
  waiting_lines_.drop();
}

}  // namespace iog::grid
