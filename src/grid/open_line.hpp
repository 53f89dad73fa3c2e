// A line of beams whose carving waits: the beams of other layers may share it.
#pragma once

#include <cstdint>

#include "grid/free_steps.hpp"
#include "traversal/ruler.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// All beams of one sensor, one Layer::line and one azimuth have the line of `beam`. Its end_z is
// that of the beam looked at last.
struct OpenLine {
  const vehicle::Sensor* sensor = nullptr;
  std::uint16_t azimuth_ticks = 0;
  vehicle::Direction direction;
  vehicle::Beam beam{vehicle::BeamLine({}, {}), 0};
  traversal::Ruler<vehicle::kResolution> ruler{beam.line, {}};
  bool starts_in_grid = false;
  FreeSteps steps;

  [[nodiscard]] bool is_of(const vehicle::Sensor& other, std::uint16_t ticks) const {
    return sensor == &other && azimuth_ticks == ticks;
  }

  void aim(const vehicle::Sensor& new_sensor, const vehicle::Layer& layer, std::uint16_t ticks) {
    sensor = &new_sensor;
    azimuth_ticks = ticks;
    direction = vehicle::direction_of(new_sensor, ticks);
    beam.line = vehicle::line_of(new_sensor, layer, direction);
    ruler = {beam.line, new_sensor.range};
    starts_in_grid = vehicle::kGridArea.contains(beam.line.cell({}));
  }

  [[nodiscard]] traversal::Position through(std::uint32_t distance_mm) const {
    return ruler.through(distance_mm, beam.line, sensor->range);
  }
};

}  // namespace iog::grid
