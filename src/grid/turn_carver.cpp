#include "grid/turn_carver.hpp"

#include <algorithm>
#include <limits>

namespace iog::grid {

using traversal::Position;

// Lines wait by the steps of one sensor.
void TurnCarver::turn_from_another(const vehicle::Sensor& sensor, const ground::Ground* ground) {
  carve_waiting();
  sensor_ = &sensor;
  layers_ = &lines_.layers_of(sensor);
  ground_ = ground;
  behind_mm_ = BandLimits::behind_mm(sensor);
}

// Another line in its place is carved and makes room.
void TurnCarver::begin_line(std::uint32_t azimuth_step) {
  waiting_.take(azimuth_step, [&](auto&&... line) { carve_line(line...); });
  waiting_.begin(azimuth_step, lines_.on_car(*sensor_, azimuth_step));
}

// A point that is not a millimetre away has nothing before it to carve.
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
                            const RankSet& behind_band) {
  KeptLine& line = lines_.line(*sensor_, azimuth_step);
  steps_.begin_at(line.in_grid().first);
  const std::uint32_t sector = ground_ == nullptr ? 0 : ground_->beams().sector_of(azimuth_step);
  if (ground_ == nullptr) {
    const std::uint32_t far_hits = add_points(line, points, layers_->far_mm, sector);
    add_behind_band(steps_.free, line, behind_band, far_hits,
                    [&line, layers = layers_](std::uint32_t rank) {
                      return line.end_in_band(layers->layers[layers->by_rank[rank]].band);
                    });
  } else {
    const ground::Exits& exits = ground_->exits();
    const auto to_mm = [&](std::uint32_t rank) {
      return exits.to_mm(sector, exits.by_rank(sector, rank));
    };
    const std::uint32_t far_mm = to_mm(layers_->near_rank) + behind_mm_;
    const std::uint32_t far_hits = add_points(line, points, far_mm, sector);
    add_behind_band(steps_.free, line, behind_band, far_hits, [&](std::uint32_t rank) {
      return LocalBeam::end_of(*sensor_, line, to_mm(rank));
    });
  }
  if (!steps_.free.is_empty()) {
    if (beams_.keeps_heights()) {
      add_low_behind_band(line, behind_band, sector);
    }
    beams_.carve(line, steps_);
  }
}

// Returns how many of them are hits at far_mm or beyond. Nearly all are hits, whose beams are in
// the band from the start.
template <bool kWithHeights>
std::uint32_t TurnCarver::add_points(FreeSteps& steps, const KeptLine& line,
                                     std::span<const WaitingPoint> points, std::uint32_t far_mm,
                                     std::uint32_t sector) {
  const LinePart in_grid = line.in_grid();
  std::uint32_t beams = 0;
  std::uint32_t far_hits = 0;
  Between last = in_grid.first;
  for (const WaitingPoint point : points) {
    if (!point.evidence().is_whole_hit()) {
      add_rare(line, point, sector);
      continue;
    }
    const std::uint32_t range_mm = point.along_mm();
    const Position hit = line.through(*sensor_, range_mm);
    const LinePart part{in_grid.first, std::min(in_grid.end, Between::before(hit))};
    if (!part.is_empty()) {
      [[maybe_unused]] const Between freed =
          BeamCarver::add_zones(*sensor_, steps, line, part, range_mm);
      if constexpr (kWithHeights) {
        if (may_be_low(point, sector)) {
          add_low(line, {part.first, freed}, point, sector);
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

// What a beam frees, those of lower rank free, too, and from some rank on so do far hits. After
// enough of them it adds nothing, and neither does one of higher rank.
template <typename EndOf>
void TurnCarver::add_behind_band(FreeSteps& steps, const KeptLine& line, const RankSet& ranks,
                                 std::uint32_t far_hits, EndOf end_of) const {
  const std::int32_t freer = -sensor_->profile.free;
  const std::uint32_t enough_beams = layers_->enough_beams;
  const std::uint32_t near_rank = layers_->near_rank;
  std::uint32_t beams = 0;
  Between last = line.in_grid().first;
  ranks.visit_while([&](std::uint32_t rank) {
    if (beams + (rank < near_rank ? 0 : far_hits) >= enough_beams) {
      return false;
    }
    const Between end = end_of(rank);
    steps.add(end, -freer);
    last = std::max(last, end);
    ++beams;
    return true;
  });
  steps.add_beams(beams, freer, last);
}

// Where its beam ends to be low has to be found only where that is before the hit.
void TurnCarver::add_low(const KeptLine& line, const LinePart& freed, WaitingPoint hit,
                         std::uint32_t sector) {
  if (ground_ == nullptr) {
    steps_.add_low(freed.within(line.in_band(layers_->low[hit.layer()])));
    return;
  }
  const ground::Ground::Stretch low = ground_->low_stretch(sector, hit.layer());
  if (low.from_mm < low.to_mm) {
    const Between first = Between::before(line.through(*sensor_, low.from_mm));
    const Between end =
        hit.along_mm() <= low.to_mm ? freed.end : LocalBeam::end_of(*sensor_, line, low.to_mm);
    steps_.add_low(freed.within({first, end}));
  }
}

// All of them count, also those that make nothing freer. They come by where they leave the band,
// the farthest first, so that nearly all of what overlaps is one. A beam that begins low may end to
// be so before one that leaves the band sooner.
void TurnCarver::add_low_behind_band(const KeptLine& line, const RankSet& ranks,
                                     std::uint32_t sector) {
  if (ground_ != nullptr) {
    add_low_over_ground(line, ranks, sector);
    return;
  }
  LinePart all;
  ranks.visit_while([&](std::uint32_t rank) {
    const LinePart part = line.in_band(layers_->low[layers_->by_rank[rank]]);
    if (part.is_empty()) {
      return true;
    }
    if (!all.is_empty() && part.end >= all.first) {
      all = {std::min(all.first, part.first), std::max(all.end, part.end)};
    } else {
      steps_.add_low(all);
      all = part;
    }
    return true;
  });
  steps_.add_low(all);
}

// A part of a line in which beams are low. Not inlined, so that the steps' address is in a
// register.
[[gnu::noinline]] void TurnCarver::add_low_stretch(LineSteps& steps, const KeptLine& line,
                                                   ground::Ground::Stretch stretch) const {
  steps.add_low(LocalBeam::part_of(*sensor_, line, stretch));
}

// The same in millimetres, so that a line is asked for the ends of what is left.
void TurnCarver::add_low_over_ground(const KeptLine& line, const RankSet& ranks,
                                     std::uint32_t sector) {
  const ground::Exits& exits = ground_->exits();
  ground::Ground::Stretch all{.from_mm = std::numeric_limits<std::uint32_t>::max(), .to_mm = 0};
  const auto add_all = [&] {
    if (all.from_mm < all.to_mm) {
      add_low_stretch(steps_, line, all);
    }
  };
  ranks.visit_while([&](std::uint32_t rank) {
    const ground::Ground::Stretch low = ground_->low_stretch(sector, exits.by_rank(sector, rank));
    if (low.from_mm >= low.to_mm) {
      return true;
    }
    if (low.to_mm < all.from_mm || low.from_mm > all.to_mm) {
      add_all();
      all = low;
    } else {
      all = {.from_mm = std::min(all.from_mm, low.from_mm),
             .to_mm = std::max(all.to_mm, low.to_mm)};
    }
    return true;
  });
  add_all();
}

// What is no hit with all of its beam in the band, and carves or marks nevertheless.
void TurnCarver::add_rare(const KeptLine& line, WaitingPoint point, std::uint32_t sector) {
  const TurnLayer& layer = layers_->layers[point.layer()];
  const auto add = [&](const auto& beam) {
    beams_.add(*sensor_, beam, point.beam(),
               [this](const auto& /*beam*/, Between /*end*/) -> LineSteps& { return steps_; });
  };
  if (ground_ == nullptr) {
    add(TurnBeam(line, *layers_, point.layer()));
  } else {
    add(LocalBeam(*sensor_, line, layer, ground_->exits().to_mm(sector, point.layer()),
                  ground_->low_stretch(sector, point.layer())));
  }
}

}  // namespace iog::grid
