// The bytes of a vehicle: all that its description has become, as the car block of an image has
// them (docs/spec.md, section 8.4). Two vehicles that differ in anything have different bytes.
//
// Every member is an integer, written most significant byte first in as many bytes as its type has;
// a truth is a byte, a text its letters and a 0; a format is its name. Left out is what follows
// from other members (vehicle/derived.hpp), and what is not in use of tables of fixed size.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "geometry/grid.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicle {
namespace content_detail {

// put(byte) takes one byte after another.
template <typename Put>
class Writer {
 public:
  explicit constexpr Writer(Put put) : put_(std::move(put)) {}

  template <typename Member>
  requires std::integral<Member>
  constexpr Writer& add(Member value) {
    const std::uint64_t bits = static_cast<std::make_unsigned_t<Member>>(value);
    for (std::size_t byte = sizeof(Member); byte-- > 0;) {
      put_(static_cast<std::uint8_t>(bits >> (8 * byte)));
    }
    return *this;
  }
  constexpr Writer& add(bool value) { return add(static_cast<std::uint8_t>(value ? 1 : 0)); }
  template <typename Member>
  requires std::is_enum_v<Member>
  constexpr Writer& add(Member value) { return add(static_cast<std::uint8_t>(value)); }
  constexpr Writer& add(std::string_view text) {
    for (const char letter : text) {
      put_(static_cast<std::uint8_t>(letter));
    }
    return add(std::uint8_t{0});
  }
  constexpr Writer& add(auto const& member, auto const&... more) requires(sizeof...(more) > 0) {
    add(member);
    return add(more...);
  }

 private:
  Put put_;
};

constexpr void add_layer(auto& out, const Layer& layer) {
  for (const EndCoordinate& axis : {layer.x, layer.y, layer.z}) {
    out.add(axis.base, axis.forward, axis.left);
  }
  out.add(layer.line, layer.range_share);
}

constexpr void add_profile(auto& out, const sensor_model::Profile& profile) {
  out.add(profile.free, profile.hit, profile.near_before_count, profile.near_after_count);
  for (std::size_t i = 0; i < sensor_model::kMaxNearCells; ++i) {
    out.add(profile.near_before[i], profile.near_after[i]);
  }
}

constexpr void add_sensor(auto& out, const Sensor& sensor) {
  out.add(sensor.name, lidar::name_of(sensor.format), sensor.source_ipv4, sensor.udp_port);
  out.add(sensor.origin.x, sensor.origin.y, sensor.origin_z, sensor.layers_share_lines);
  out.add(sensor.azimuths.ticks_per_turn(), sensor.azimuths.steps_per_turn());
  out.add(sensor.range.mm(), sensor.range_min_mm, sensor.precision_mm);
  out.add(sensor.no_return_clears_mm, sensor.scan_width_ticks, sensor.max_points_per_scan);
  out.add(sensor.is_synchronised, sensor.latency_us, sensor.layer_count);
  for (const Layer& layer : std::span(sensor.layers).first(sensor.layer_count)) {
    add_layer(out, layer);
  }
  out.add(sensor.is_calibrated);
  for (const lidar::LaserCorrection& laser : sensor.unit().corrections) {
    out.add(laser.azimuth_ticks, laser.range_mm);
  }
  out.add(sensor.columns_per_turn, sensor.column_ns);
  add_profile(out, sensor.profile);
}

constexpr void add_window(auto& out, const window::Rules& rules) {
  out.add(rules.discounting, rules.weighing, rules.moved, rules.group_budget);
  out.add(rules.assignment != nullptr);
  if (rules.assignment != nullptr) {
    for (std::size_t i = 0; i < evidence::kGradedIndexes; ++i) {
      out.add(rules.assignment->occupied[i], rules.assignment->free[i]);
    }
    out.add(rules.assignment->free_by_time);
  }
}

}  // namespace content_detail

// put(std::uint8_t) is called for each byte. The grid comes first: tables are in its subcells.
template <typename Put>
constexpr void write_content(const Vehicle& vehicle, Put put) {
  content_detail::Writer out(std::move(put));
  out.add(static_cast<std::uint16_t>(geometry::kCellMm),
          static_cast<std::uint16_t>(geometry::kCellsPerSide),
          static_cast<std::uint16_t>(geometry::kResolution));
  out.add(vehicle.name, vehicle.footprint.x_min, vehicle.footprint.x_max);
  out.add(vehicle.footprint.y_min, vehicle.footprint.y_max, vehicle.z_min, vehicle.z_max);
  out.add(vehicle.rule, vehicle.quantisation, vehicle.frame_period_us, vehicle.grids);
  out.add(vehicle.poses.source_ipv4, vehicle.poses.udp_port, vehicle.poses.log2_slice_ms);
  out.add(vehicle.maps.source_ipv4, vehicle.maps.udp_port);
  content_detail::add_window(out, vehicle.window);
  out.add(static_cast<std::uint8_t>(vehicle.sensors.size()));
  for (const Sensor& sensor : vehicle.sensors) {
    content_detail::add_sensor(out, sensor);
  }
}

}  // namespace iog::vehicle
