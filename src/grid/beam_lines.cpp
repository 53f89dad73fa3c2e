#include "grid/beam_lines.hpp"

#include <algorithm>

#include "geometry/grid.hpp"
#include "traversal/corner.hpp"
#include "traversal/same_cells.hpp"

namespace iog::grid {

using traversal::Position;
using traversal::Stretch;
using vehicle::Sensor;

// A line crosses a border at least every one and a half cells. So the cell that contains a point
// that far behind the part lies outside the part. The first zone begins at most one 1D cell more
// before the point than there are zones.
std::uint32_t BandLimits::behind_mm(const Sensor& sensor) {
  const std::uint32_t zones_mm = (sensor.profile.near_before_count + 1U) * sensor.precision_mm;
  return zones_mm + 3 * std::uint32_t{sensor.grid.cell_mm} / 2 + 1;
}

// For beams that end where the line ends. Beams are straight, so a shorter one leaves the band at
// the same place.
BandLimits::BandLimits(const vehicle::HeightBand& band, const Sensor& sensor, std::int32_t end_z) {
  const vehicle::BandPart part = vehicle::part_in_band(band, sensor, end_z, sensor.range.mm());
  is_empty_ = part.is_empty;
  if (!part.is_empty) {
    const traversal::Share to = part.is_whole ? traversal::Share{1, 1} : part.to;
    const numeric::Divisor rise(static_cast<std::uint32_t>(to.denominator));
    is_from_start_ = part.from.numerator == 0;
    from_ = {part.from, rise, sensor.range};
    to_ = {to, rise, sensor.range};
    is_free_before_mm_ =
        (to_.distance() >> traversal::MeasuredShare::kFractionBits) + behind_mm(sensor);
  }
}

// Most lines have both ends in the grid. Then all of the line is in the grid, and no division is
// needed.
void KeptLine::find(const Sensor& sensor, const vehicle::Layer& layer, std::uint32_t azimuth_step) {
  line_ = vehicle::line_of(sensor, layer, vehicle::direction_of(sensor, azimuth_step));
  ruler_ = {line_, sensor.range};
  const Position last = line_.before_end();
  const geometry::CellArea area = sensor.grid.area();
  const bool starts_in_grid = area.contains(line_.cell({}));
  in_grid_ = {{}, Between::after(last)};
  if (!starts_in_grid || !area.contains(line_.cell(last))) {
    const std::optional<Stretch> stretch = line_.clip(area);
    if (stretch && stretch->first.crossed() <= last.crossed()) {
      in_grid_.first = Between::before(stretch->first);
      in_grid_.end =
          stretch->last.crossed() < last.crossed() ? Between::after(stretch->last) : in_grid_.end;
    } else {
      in_grid_.end = {};
    }
  }
  has_path_ = starts_in_grid && !traversal::may_meet_corner(line_);
  path_begun_ = false;
  number_ = static_cast<std::uint16_t>(layer.line);
}

FreePart KeptLine::part_in(const vehicle::HeightBand& band, const Sensor& sensor,
                           std::int32_t end_z) const {
  const BandLimits limits(band, sensor, end_z);
  return {in_band(limits), limits.is_free_before_mm()};
}

void KeptBeam::find(const Sensor& sensor, std::int32_t end_z, KeptLine& line) {
  ranges_ = vehicle::ranges_of(sensor, {line.line(), end_z});
  in_band_ = {};
  line_ = &line;
}

void KeptHeight::find(const vehicle::Layer& layer, const vehicle::Direction& direction) {
  end_z_ = vehicle::end_height_of(layer, direction);
  has_low_ = false;
}

void KeptAzimuth::begin(const Sensor& sensor, std::uint32_t step) {
  sensor_ = &sensor;
  step_ = step;
  has_line_ = {};
  beams_found_ = 0;
  common_ = 0;
  different_ = 0;
  is_asked_for_ = true;
}

KeptLine& KeptAzimuth::line_of(const Sensor& sensor, const vehicle::Layer& layer) {
  if (!has_line_[layer.line]) {
    lines_[layer.line].find(sensor, layer, step_);
    has_line_[layer.line] = true;
    if (has_line_[0] && has_line_[1] && lines_[0].has_path()) {
      different_ = kNotKnown;
    }
  }
  return lines_[layer.line];
}

KeptBeam& KeptAzimuth::find_beam(const Sensor& sensor, std::uint8_t layer) {
  const vehicle::Layer& its_layer = sensor.layers[layer];
  heights_[layer].find(its_layer, vehicle::direction_of(sensor, step_));
  beams_[layer].find(sensor, heights_[layer].end_z(), line_of(sensor, its_layer));
  beams_found_ |= 1U << layer;
  return beams_[layer];
}

bool KeptAzimuth::find_common(std::uint32_t cells) {
  const bool is_so = traversal::same_cells(lines_[0].line(), lines_[1].line(), cells);
  (is_so ? common_ : different_) = cells;
  return is_so;
}

BeamLines::BeamLines(std::span<const Sensor> sensors)
    : first_sensor_(sensors.data()),
      places_per_sensor_(kPlaces /
                         static_cast<std::uint32_t>(std::max<std::size_t>(sensors.size(), 1))) {}

// A LUX covers 110 degrees, 3,520 of its steps. The slots cover 3,584 consecutive steps. The
// product wraps at 32 bits, which discards whole rounds.
KeptAzimuth& BeamLines::azimuth(const Sensor& sensor, std::uint32_t step) {
  const auto number = static_cast<std::uint32_t>(&sensor - first_sensor_);
  // Steps to the right of a sensor come before those to its left.
  const std::uint32_t turn = sensor.azimuths.steps_per_turn();
  const std::uint32_t in_order = step < turn / 2 ? step + turn : step;
  constexpr std::uint32_t kShareOfStep = (std::uint64_t{1} << 32) / 3584 + 1;
  const std::uint32_t share_of_round = in_order * kShareOfStep;
  const std::uint64_t places = std::uint64_t{share_of_round} * places_per_sensor_;
  const auto place = static_cast<std::uint32_t>(places >> 32);
  KeptAzimuth& own_place = azimuths_[number * places_per_sensor_ + place];
  if (own_place.is_of(sensor, step)) {
    own_place.stay();
    return own_place;
  }
  KeptAzimuth& azimuth = own_place.gives_way() ? own_place : spare_;
  azimuth.begin(sensor, step);
  return azimuth;
}

}  // namespace iog::grid
