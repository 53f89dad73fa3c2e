#include "grid/azimuth_carver.hpp"

#include <bit>

namespace iog::grid {
namespace {

bool may_leave(vehicle::Evidence evidence) {
  return evidence.carves() && !evidence.is_whole_in_band();
}

}  // namespace

using vehicle::Sensor;

void AzimuthCarver::turn_to(const Sensor& sensor, std::uint16_t azimuth_ticks) {
  carve_waiting();
  sensor_ = &sensor;
  azimuth_ticks_ = azimuth_ticks;
  further_found_ = 0;
  azimuth_step_ = sensor.azimuths.nearest(azimuth_ticks);
  kept_ = &lines_.azimuth(sensor, azimuth_step_);
}

// Beams that KeptAzimuth has no room for are computed for each point.
KeptBeam& AzimuthCarver::find_beam(std::uint8_t layer) {
  const vehicle::Layer& its = sensor_->layers[layer];
  if (its.line >= KeptAzimuth::kMaxLines) {
    return find_further_beam(its, further_line(its));
  }
  return layer < KeptAzimuth::kMaxLayers ? kept_->find_beam(*sensor_, layer)
                                         : find_further_beam(its, kept_->line_of(*sensor_, its));
}

KeptBeam& AzimuthCarver::find_further_beam(const vehicle::Layer& layer, KeptLine& line) {
  further_height_.find(layer, vehicle::direction_of(*sensor_, azimuth_step_));
  further_beam_.find(*sensor_, further_height_.end_z(), line);
  return further_beam_;
}

// Beams pending on another line in this slot are carved first.
KeptLine& AzimuthCarver::further_line(const vehicle::Layer& layer) {
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

void AzimuthCarver::take(KeptBeam& beam, const WaitingBeam& its) {
  const bool leaves_band = may_leave(its.evidence);
  if (leaves_band && !beam.has_band()) {
    find_band(beam);
  }
  take(beam, its, leaves_band ? &beam.in_band() : nullptr,
       [&] { return height_of(beam).low_part(*vehicle_, *sensor_, beam.line()); });
}

void AzimuthCarver::take(KeptBeam& beam, const WaitingBeam& its, const ground::Ground& ground,
                         std::uint32_t sector, std::uint8_t layer) {
  const KeptLine& line = beam.line();
  FreePart limits;
  const bool leaves_band = may_leave(its.evidence);
  if (leaves_band) {
    const std::uint32_t exit_mm = ground.exits().to_mm(sector, layer);
    limits = {{line.in_grid().first, line.end_at(*sensor_, exit_mm)},
              exit_mm + BandLimits::behind_mm(*sensor_)};
  }
  take(beam, its, leaves_band ? &limits : nullptr, [&] {
    const ground::Ground::Stretch low = ground.low_stretch(sector, layer);
    return line.part_between(*sensor_, low.from_mm, low.to_mm);
  });
}

void AzimuthCarver::find_band(KeptBeam& beam) {
  beam.find_band(vehicle_->band(), *sensor_, height_of(beam).end_z());
}

bool AzimuthCarver::is_tall(const KeptBeam& beam, std::uint32_t range_mm) {
  return height_of(beam).is_tall(*sensor_, range_mm);
}

template <typename LowOf>
inline void AzimuthCarver::take(KeptBeam& beam, const WaitingBeam& its, const FreePart* limits,
                                LowOf&& low_of) {
  beams_.add(
      *sensor_, {.line = beam.line(), .limits = limits, .clears_mm = sensor_->no_return_clears_mm},
      its, [&](Between end) -> LineSteps& { return steps_of(beam.line(), end); }, low_of);
}

// The steps in which a beam is collected. If the beam crosses the same cells as the first line up
// to its end, it joins the beams of the first line.
inline LineSteps& AzimuthCarver::steps_of(KeptLine& line, Between end) {
  const bool shares = line.number() == 1 && kept_->is_common(end.at().crossed() + 1);
  return steps_on(shares ? kept_->first_line() : line);
}

inline LineSteps& AzimuthCarver::steps_on(KeptLine& line) {
  if (latest_->line != &line) {
    latest_ = &open(line);
  }
  if (!latest_->steps.free.has_room()) {
    beams_.carve(line, latest_->steps);
  }
  return latest_->steps;
}

// If another line occupies the slot, it is carved first.
AzimuthCarver::OpenLine& AzimuthCarver::open(KeptLine& line) {
  const std::uint32_t place = place_of(line.number());
  OpenLine& open = open_lines_[place];
  if (open.line != &line) {
    carve_place(place);
    lines_in_use_ |= 1U << place;
    open.line = &line;
    open.steps.begin_at(line.in_grid().first);
  }
  return open;
}

void AzimuthCarver::carve_place(std::uint32_t place) {
  if ((lines_in_use_ >> place & 1U) != 0) {
    OpenLine& open = open_lines_[place];
    beams_.carve(*open.line, open.steps);
    open.line = nullptr;
    lines_in_use_ &= ~(1U << place);
  }
}

void AzimuthCarver::carve_waiting() {
  while (lines_in_use_ != 0) {
    carve_place(static_cast<std::uint32_t>(std::countr_zero(lines_in_use_)));
  }
}

void AzimuthCarver::drop_waiting() {
  for (OpenLine& open : open_lines_) {
    open.steps.drop();
    open.line = nullptr;
  }
  lines_in_use_ = 0;
}

}  // namespace iog::grid
