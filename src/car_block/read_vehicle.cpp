#include "car_block/read_vehicle.hpp"

#include <bit>

#include "car_block/content_reader.hpp"
#include "geometry/grid.hpp"
#include "lidar/formats.hpp"
#include "vehicle/derived.hpp"

namespace iog::car_block {
namespace {

lidar::Format read_format(ContentReader& in) {
  const std::string_view name = in.text();
  std::uint8_t number = 0;
  while (number < lidar::kFormatCount &&
         lidar::name_of(static_cast<lidar::Format>(number)) != name) {
    ++number;
  }
  in.demand(number < lidar::kFormatCount);
  return static_cast<lidar::Format>(number < lidar::kFormatCount ? number : 0);
}

bool can_be_steps(std::uint32_t steps, std::uint32_t ticks_per_turn, bool turns) {
  if (!turns) {
    return steps == ticks_per_turn;
  }
  return std::has_single_bit(steps) && steps >= vehicle::kFewestAzimuthSteps &&
         steps <= vehicle::kMostAzimuthSteps;
}

// Its tables follow from two numbers, of which the format gives the first.
void read_azimuths(ContentReader& in, vehicle::Sensor& sensor) {
  const std::uint32_t ticks_per_turn = in.u32();
  const std::uint32_t steps = in.u32();
  lidar::with_decoder(sensor.format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    const bool fits = ticks_per_turn == std::uint32_t{Decoder::kTicksPerTurn} &&
                      can_be_steps(steps, ticks_per_turn, Decoder::kTurns);
    in.demand(fits);
    if (fits) {
      vehicle::derive_azimuths<Decoder>(steps, sensor);
    }
  });
}

vehicle::EndCoordinate read_coordinate(ContentReader& in) {
  vehicle::EndCoordinate coordinate;
  coordinate.base = in.i64();
  coordinate.forward = in.i32();
  coordinate.left = in.i32();
  return coordinate;
}

void read_layers(ContentReader& in, vehicle::Sensor& sensor) {
  sensor.layer_count = in.below(vehicle::kMaxLayers + 1);
  for (std::size_t i = 0; i < sensor.layer_count && in.ok(); ++i) {
    vehicle::Layer& layer = sensor.layers[i];
    layer.x = read_coordinate(in);
    layer.y = read_coordinate(in);
    layer.z = read_coordinate(in);
    layer.line = in.u8();
    layer.range_share = in.u32();
  }
  sensor.is_calibrated = in.truth();
  for (std::size_t i = 0; sensor.is_calibrated && i < sensor.layer_count && in.ok(); ++i) {
    sensor.laser_corrections[i].azimuth_ticks = in.i16();
    sensor.laser_corrections[i].range_mm = in.i16();
  }
}

void read_profile(ContentReader& in, sensor_model::Profile& profile) {
  profile.free = in.i8();
  profile.hit = in.i8();
  profile.near_before_count = in.below(sensor_model::kMaxNearCells + 1);
  profile.near_after_count = in.below(sensor_model::kMaxNearCells + 1);
  for (std::size_t i = 0; i < sensor_model::kMaxNearCells; ++i) {
    profile.near_before[i] = in.i8();
    profile.near_after[i] = in.i8();
  }
}

void read_sensor(ContentReader& in, vehicle::Sensor& sensor) {
  sensor.name = in.text();
  sensor.format = read_format(in);
  sensor.source_ipv4 = in.u32();
  sensor.udp_port = in.u16();
  sensor.origin.x = in.i32();
  sensor.origin.y = in.i32();
  sensor.origin_z = in.i32();
  sensor.layers_share_lines = in.truth();
  read_azimuths(in, sensor);
  // A length of 0 has no reciprocal; the limits refuse it.
  const std::uint32_t range_mm = in.u32();
  in.demand(range_mm > 0 && range_mm < std::uint32_t{1} << 18);
  sensor.range = traversal::LineLength(in.ok() ? range_mm : 1);
  sensor.range_min_mm = in.u32();
  sensor.precision_mm = in.u32();
  sensor.no_return_clears_mm = in.u32();
  sensor.scan_width_ticks = in.u16();
  sensor.max_points_per_scan = in.u32();
  sensor.is_synchronised = in.truth();
  sensor.latency_us = in.u32();
  read_layers(in, sensor);
  sensor.columns_per_turn = in.u16();
  sensor.column_ns = in.u32();
  read_profile(in, sensor.profile);
}

// One of those that the firmware has, or none.
const evidence::Assignment* read_assignment(ContentReader& in) {
  if (!in.truth()) {
    return nullptr;
  }
  evidence::Assignment read;
  for (std::size_t i = 0; i < evidence::kGradedIndexes; ++i) {
    read.occupied[i] = in.u8();
    read.free[i] = in.u8();
  }
  read.free_by_time = in.i16();
  if (read == evidence::kReinforced) {
    return &evidence::kReinforced;
  }
  in.demand(read == evidence::kIsopignistic);
  return &evidence::kIsopignistic;
}

void read_window(ContentReader& in, window::Rules& rules) {
  rules.discounting = in.word<ageing::Discounting>(4);
  rules.weighing = in.word<ageing::Weighing>(2);
  rules.moved = in.word<window::Moved>(2);
  rules.group_budget = in.u32();
  rules.assignment = read_assignment(in);
}

void read_car(ContentReader& in, vehicle::Vehicle& car) {
  car.name = in.text();
  car.footprint.x_min = in.i32();
  car.footprint.x_max = in.i32();
  car.footprint.y_min = in.i32();
  car.footprint.y_max = in.i32();
  car.z_min = in.i32();
  car.z_max = in.i32();
  car.rule = in.word<vehicle::FusionRule>(2);
  car.quantisation = in.word<index::Quantisation>(2);
  car.frame_period_us = in.u32();
  car.grids = in.word<vehicle::Grids>(3);
  car.poses.source_ipv4 = in.u32();
  car.poses.udp_port = in.u16();
  car.poses.log2_slice_ms = in.u8();
  car.maps.source_ipv4 = in.u32();
  car.maps.udp_port = in.u16();
  read_window(in, car.window);
}

}  // namespace

SensorMemory::SensorMemory() = default;

Refusal read_vehicle(std::span<const std::byte> content, SensorMemory& memory,
                     vehicle::Vehicle& vehicle) {
  ContentReader in(content);
  const std::uint16_t cell_mm = in.u16();
  const std::uint16_t cells_per_side = in.u16();
  const std::uint16_t resolution = in.u16();
  if (in.ok() && (cell_mm != geometry::kCellMm || cells_per_side != geometry::kCellsPerSide ||
                  resolution != geometry::kResolution)) {
    return Refusal::kOtherGrid;
  }
  read_car(in, vehicle);
  const std::size_t sensors = in.below(vehicle::kMaxSensors + 1);
  for (std::size_t i = 0; i < sensors && in.ok(); ++i) {
    read_sensor(in, memory.sensors[i]);
  }
  vehicle.sensors = std::span(memory.sensors).first(in.ok() ? sensors : 0);
  return in.ok() && in.is_at_end() ? Refusal::kNone : Refusal::kNotACar;
}

}  // namespace iog::car_block
