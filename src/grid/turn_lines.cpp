#include "grid/turn_lines.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "index/occupancy_index.hpp"
#include "numeric/heap_sort.hpp"
#include "require/require.hpp"

namespace iog::grid {
namespace {

// Ranks the layers by how far they stay in the band.
void rank(const vehicle::Sensor& sensor, TurnLayers& turn_layers) {
  const auto layers = std::span(turn_layers.layers).first(sensor.layer_count);
  const auto by_rank = std::span(turn_layers.by_rank).first(sensor.layer_count);
  std::iota(by_rank.begin(), by_rank.end(), std::uint8_t{0});
  numeric::heap_sort(by_rank, [&](std::uint8_t a, std::uint8_t b) {
    const bool is_first = layers[a].band.ends_behind(layers[b].band);
    return is_first || (a < b && !layers[b].band.ends_behind(layers[a].band));
  });
  for (std::uint32_t rank = 0; rank < by_rank.size(); ++rank) {
    layers[by_rank[rank]].rank = rank;
  }
  const std::int32_t freer = -sensor.profile.free;
  turn_layers.enough_beams =
      static_cast<std::uint32_t>((index::kIndexMax<OccupancyIndex> + freer - 1) / freer);
  turn_layers.zones_mm = BandLimits::behind_mm(sensor);
  turn_layers.near_rank = sensor.layer_count / 2U;
  turn_layers.far_mm = layers[by_rank[turn_layers.near_rank]].band.is_free_before_mm();
  turn_layers.start_in_band =
      std::ranges::all_of(layers, [](const TurnLayer& layer) { return layer.in_band.first == 0; });
  if (turn_layers.start_in_band) {
    for (TurnLayer& layer : layers) {
      layer.behind_mm = layer.band.is_free_before_mm();
    }
  }
}

}  // namespace

TurnLines::TurnLines(const vehicle::Vehicle& vehicle) : first_sensor_(vehicle.sensors.data()) {
  std::uint32_t places = 0;
  for (std::size_t i = 0; i < vehicle.sensors.size(); ++i) {
    const vehicle::Sensor& sensor = vehicle.sensors[i];
    if (sensor.layers_share_lines) {
      first_[i] = places;
      places += sensor.azimuths.steps_per_turn();
      for (std::size_t layer = 0; layer < sensor.layer_count; ++layer) {
        const vehicle::Layer& described = sensor.layers[layer];
        const std::int32_t end_z = vehicle::end_height_of(described, {});
        layers_[i].layers[layer] = {
            .range_share = described.range_share,
            .in_band = vehicle::ranges_in_band(sensor, end_z),
            .clears_mm = described.along_line_mm(sensor.no_return_clears_mm),
            .band = BandLimits(vehicle.band(), sensor, end_z)};
        layers_[i].tall[layer] = vehicle::tall_ranges(sensor, end_z);
        layers_[i].low[layer] = BandLimits(vehicle.low_band(sensor), sensor, end_z);
      }
      rank(sensor, layers_[i]);
    }
  }
  require(places <= vehicle::kMaxTurnLines);
}

void TurnLines::find(const vehicle::Sensor& sensor, std::uint32_t azimuth_step,
                     std::uint32_t place) {
  KeptLine& line = lines_[place];
  line.find(sensor, sensor.layers[0], azimuth_step);
  on_car_[place] = {.ranges = vehicle::ranges_on_car(sensor, line.line()), .is_known = true};
}

}  // namespace iog::grid
