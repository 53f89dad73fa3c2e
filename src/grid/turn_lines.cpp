#include "grid/turn_lines.hpp"

#include "require/require.hpp"

namespace iog::grid {

TurnLines::TurnLines(const vehicle::Vehicle& vehicle) : first_sensor_(vehicle.sensors.data()) {
  std::uint32_t places = 0;
  for (std::size_t i = 0; i < vehicle.sensors.size(); ++i) {
    const vehicle::Sensor& sensor = vehicle.sensors[i];
    if (sensor.layers_share_lines) {
      first_[i] = places;
      places += sensor.azimuths.steps_per_turn();
      for (std::size_t layer = 0; layer < sensor.layer_count; ++layer) {
        const vehicle::Layer& its = sensor.layers[layer];
        const std::int32_t end_z = vehicle::end_height_of(its, {});
        layers_[i][layer] = {.range_share = its.range_share,
                             .in_band = vehicle::ranges_in_band(sensor, end_z),
                             .clears_mm = its.along_line_mm(sensor.no_return_clears_mm),
                             .band = BandLimits(vehicle, sensor, end_z)};
      }
    }
  }
  require(places <= vehicle::kMaxTurnLines);
}

void TurnLines::find(const vehicle::Sensor& sensor, std::uint32_t azimuth_step, TurnLine& line) {
  line.line.find(sensor, sensor.layers[0], azimuth_step);
  line.on_car = vehicle::ranges_on_car(sensor, line.line.line());
  line.is_found = true;
}

void TurnLines::forget() {
  for (TurnLine& line : lines_) {
    line.is_found = false;
  }
}

}  // namespace iog::grid
