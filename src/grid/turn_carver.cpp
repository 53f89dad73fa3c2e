#include "grid/turn_carver.hpp"

#include <algorithm>

namespace iog::grid {

using traversal::Position;

// Pending lines are indexed by the steps of one sensor.
void TurnCarver::turn_from_another(const vehicle::Sensor& sensor, const ground::Ground* ground) {
  carve_waiting();
  sensor_ = &sensor;
  layers_ = &lines_.layers_of(sensor);
  ground_ = ground;
}

// If another line occupies the slot, it is carved first.
void TurnCarver::begin_line(std::uint32_t azimuth_step) {
  waiting_.take(azimuth_step, [&](auto&&... line) { carve_line(line...); });
  waiting_.begin(azimuth_step, lines_.on_car(*sensor_, azimuth_step));
}

// A point less than a millimetre away has nothing before it to carve.
void TurnCarver::mark_at_start(std::uint32_t azimuth_step, bool is_tall) {
  const KeptLine& line = lines_.line(*sensor_, azimuth_step);
  beams_.mark(*sensor_, line, line.through(*sensor_, 0), 0, is_tall);
}

void TurnCarver::carve_waiting() {
  if (sensor_ != nullptr) {
    waiting_.take_all([&](auto&&... line) { carve_line(line...); });
  }
}

void TurnCarver::carve_line(std::uint32_t azimuth_step, std::span<const WaitingPoint> points,
                            const RankSet& behind) {
  KeptLine& line = lines_.line(*sensor_, azimuth_step);
  steps_.begin_at(line.in_grid().first);
  if (ground_ == nullptr) {
    add_beams(BandGate(line, *layers_), line, points, behind);
  } else {
    const std::uint32_t sector = ground_->beams().sector_of(azimuth_step);
    add_beams(GroundGate(line, *sensor_, *layers_, *ground_, sector), line, points, behind);
  }
  if (!steps_.free.is_empty()) {
    beams_.carve(line, steps_);
  }
}

template <typename Gate>
void TurnCarver::add_beams(const Gate& gate, const KeptLine& line,
                           std::span<const WaitingPoint> points, const RankSet& behind) {
  const bool with_heights = beams_.keeps_heights();
  const std::uint32_t far_hits = with_heights ? add_points<true>(steps_.free, gate, line, points)
                                              : add_points<false>(steps_.free, gate, line, points);
  add_behind(steps_.free, gate, line, behind, far_hits);
  if (with_heights && !steps_.free.is_empty()) {
    add_low_behind(gate, behind);
  }
}

// Returns how many of the points are hits at far_mm or beyond. Nearly all points are hits whose
// beams are within the limits from the start.
template <bool kWithHeights, typename Gate>
std::uint32_t TurnCarver::add_points(FreeSteps& steps, const Gate& gate, const KeptLine& line,
                                     std::span<const WaitingPoint> points) {
  const LinePart in_grid = line.in_grid();
  const std::uint32_t far_mm = gate.far_mm();
  std::uint32_t beams = 0;
  std::uint32_t far_hits = 0;
  Between last = in_grid.first;
  for (const WaitingPoint point : points) {
    if (!point.evidence().is_whole_hit()) {
      add_rare(gate, line, point);
      continue;
    }
    const std::uint32_t range_mm = point.along_mm();
    const Position hit = line.through(*sensor_, range_mm);
    const LinePart part = in_grid.up_to(Between::before(hit));
    if (!part.is_empty()) {
      [[maybe_unused]] const Between freed =
          BeamCarver::add_zones(*sensor_, steps, line, part, range_mm);
      if constexpr (kWithHeights) {
        if (gate.may_be_low(point.layer(), range_mm)) {
          add_low(steps_, gate, {part.first, freed}, point.layer());
        }
      }
      last = std::max(last, part.end);
      ++beams;
      far_hits += range_mm >= far_mm ? 1U : 0U;
    }
    beams_.mark(*sensor_, line, hit, range_mm, kWithHeights && point.is_tall());
  }
  steps.add_beams(beams, -sensor_->profile.free, last);
  return far_hits;
}

// Beams of lower rank, and from near_rank on also far hits, free everything that this beam frees.
// So after enough of them neither this beam nor one of higher rank adds anything.
template <typename Gate>
void TurnCarver::add_behind(FreeSteps& steps, const Gate& gate, const KeptLine& line,
                            const RankSet& ranks, std::uint32_t far_hits) const {
  const std::int32_t freer = -sensor_->profile.free;
  const std::uint32_t enough_beams = layers_->enough_beams;
  const std::uint32_t near_rank = layers_->near_rank;
  std::uint32_t beams = 0;
  Between last = line.in_grid().first;
  ranks.visit_while([&](std::uint32_t rank) {
    if (beams + (rank < near_rank ? 0 : far_hits) >= enough_beams) {
      return false;
    }
    const Between end = gate.end(gate.layer_of(rank));
    steps.add(end, -freer);
    last = std::max(last, end);
    ++beams;
    return true;
  });
  steps.add_beams(beams, freer, last);
}

template <typename Gate>
void TurnCarver::add_low(LineSteps& steps, const Gate& gate, const LinePart& freed,
                         std::size_t layer) {
  steps.add_low(freed.within(gate.low_part(layer)));
}

// All of these beams count, even those that free nothing more. They arrive in exit order, the
// farthest first, so nearly all overlapping parts merge into one. A beam's low part may end before
// that of a beam that leaves the limits sooner.
template <typename Gate>
void TurnCarver::add_low_behind(const Gate& gate, const RankSet& ranks) {
  LinePart all;
  ranks.visit_while([&](std::uint32_t rank) {
    const LinePart part = gate.low_part(gate.layer_of(rank));
    if (part.is_empty()) {
      return true;
    }
    if (!all.is_empty() && part.end >= all.first && part.first <= all.end) {
      all = {std::min(all.first, part.first), std::max(all.end, part.end)};
    } else {
      steps_.add_low(all);
      all = part;
    }
    return true;
  });
  steps_.add_low(all);
}

// Handles the rare points that carve or mark: those that are not hits with the whole beam within
// the limits.
template <typename Gate>
void TurnCarver::add_rare(const Gate& gate, const KeptLine& line, WaitingPoint point) {
  const std::uint32_t layer = point.layer();
  const FreePart limits = gate.part(layer);
  const bool carves = point.evidence().carves();
  beams_.add(
      *sensor_,
      {.line = line,
       .limits = carves ? &limits : nullptr,
       .clears_mm = layers_->layers[layer].clears_mm},
      point.beam(), [this](Between /*end*/) -> LineSteps& { return steps_; },
      [&] { return gate.low_part(layer); });
}

}  // namespace iog::grid
