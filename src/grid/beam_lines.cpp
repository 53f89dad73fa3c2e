#include "grid/beam_lines.hpp"

#include <algorithm>
#include <bit>

#include "geometry/grid.hpp"
#include "traversal/corner.hpp"
#include "traversal/same_cells.hpp"

namespace iog::grid {

using traversal::Position;
using traversal::Stretch;
using vehicle::Sensor;

// Most lines have both ends in the grid. Then everything between them is in the grid, too, and
// nothing is divided.
void KeptLine::find(const Sensor& sensor, const vehicle::Layer& layer,
                    vehicle::Direction direction) {
  line_ = vehicle::line_of(sensor, layer, direction);
  ruler_ = {line_, sensor.range};
  const Position last = line_.before_end();
  const bool starts_in_grid = geometry::kGridArea.contains(line_.cell({}));
  in_grid_ = {{}, {last, true}};
  if (!starts_in_grid || !geometry::kGridArea.contains(line_.cell(last))) {
    if (const std::optional<Stretch> stretch = line_.clip(geometry::kGridArea)) {
      in_grid_.begin_at(stretch->first);
      in_grid_.end_at({stretch->last, true});
    } else {
      in_grid_.end = {};
    }
  }
  has_path_ = starts_in_grid && !traversal::may_meet_corner(line_);
  path_begun_ = false;
}

void KeptAzimuth::begin(const Sensor& sensor, std::uint16_t ticks) {
  sensor_ = &sensor;
  ticks_ = ticks;
  is_found_ = {};
  beams_ = {};
  common_ = 0;
  different_ = kNotKnown;
}

KeptLine& KeptAzimuth::line_of(const Sensor& sensor, const vehicle::Layer& layer,
                               vehicle::Direction direction) {
  KeptLine& line = lines_[layer.line];
  if (!is_found_[layer.line]) {
    line.find(sensor, layer, direction);
    is_found_[layer.line] = true;
  }
  return line;
}

bool KeptAzimuth::is_common(Position last) {
  const std::uint32_t cells = last.crossed() + 1;
  if (common_ < cells && cells < different_) {
    const bool is_so = traversal::same_cells(lines_[0].line(), lines_[1].line(), cells);
    (is_so ? common_ : different_) = cells;
  }
  return cells <= common_;
}

BeamLines::BeamLines(std::span<const Sensor> sensors) : first_sensor_(sensors.data()) {
  places_per_sensor_ =
      static_cast<std::uint32_t>(kPlaces / std::bit_ceil(std::max<std::size_t>(sensors.size(), 1)));
}

// The azimuths of a LUX differ by multiples of a quarter of a degree. They have different places as
// long as there are enough places.
KeptAzimuth& BeamLines::azimuth(const Sensor& sensor, std::uint16_t ticks) {
  const auto number = static_cast<std::uint32_t>(&sensor - first_sensor_);
  const std::uint32_t place = (ticks / 8U ^ ticks / 2048U) & (places_per_sensor_ - 1);
  KeptAzimuth& azimuth = azimuths_[number * places_per_sensor_ + place];
  if (!azimuth.is_of(sensor, ticks)) {
    azimuth.begin(sensor, ticks);
  }
  return azimuth;
}

void BeamLines::forget() {
  for (KeptAzimuth& azimuth : azimuths_) {
    azimuth.forget();
  }
}

}  // namespace iog::grid
