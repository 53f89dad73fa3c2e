// A serialised car is a compiled car file as it is stored in an image (docs/spec.md, section 8.4).
// Cars that differ in any property are serialised to different bytes.
//
// The writer and the reader use the same list of members in the same order. The list omits derived
// members (vehicle/derived.hpp) and unused entries of fixed-size tables.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

#include "checksum/reflected_field.hpp"
#include "geometry/grid.hpp"
#include "lidar/scanner_facts.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::car_block {
namespace content_detail {

void visit_end(auto& content, auto& end) { content.numbers(end.base, end.forward, end.left); }

void visit_layers(auto& content, auto& sensor) {
  content.below(vehicle::kMaxLayers + 1, sensor.layer_count);
  for (std::size_t i = 0; i < sensor.layer_count && content.ok(); ++i) {
    auto& layer = sensor.layers[i];
    visit_end(content, layer.x);
    visit_end(content, layer.y);
    visit_end(content, layer.z);
    content.numbers(layer.line, layer.range_share);
  }
  content.truth(sensor.is_calibrated);
  for (std::size_t i = 0; sensor.is_calibrated && i < sensor.layer_count && content.ok(); ++i) {
    content.numbers(sensor.laser_corrections[i].azimuth_ticks,
                    sensor.laser_corrections[i].range_mm);
  }
  const bool has_own = lidar::facts_of(sensor.format).is_points;
  for (std::size_t i = 0; has_own && i < sensor.layer_count && content.ok(); ++i) {
    content.numbers(sensor.elevations[i]);
  }
}

void visit_profile(auto& content, auto& profile) {
  content.numbers(profile.free, profile.hit);
  content.below(sensor_model::kMaxNearCells + 1, profile.near_before_count);
  content.below(sensor_model::kMaxNearCells + 1, profile.near_after_count);
  for (std::size_t i = 0; i < sensor_model::kMaxNearCells; ++i) {
    content.numbers(profile.near_before[i], profile.near_after[i]);
  }
}

void visit_arc(auto& content, auto& arc) {
  content.numbers(arc.cell_ticks);
  content.below(sensor_model::kMaxArcCells + 1, arc.count);
  for (std::size_t i = 0; i < arc.count && content.ok(); ++i) {
    content.numbers(arc.marks[i]);
  }
}

// Visits the arc of an ultrasonic sensor.
void visit_cone(auto& content, auto& arc) {
  visit_arc(content, arc);
  content.numbers(arc.free);
}

void visit_sensor(auto& content, auto& sensor) {
  content.text(sensor.name);
  content.format(sensor.format);
  content.numbers(sensor.source_ipv4, sensor.udp_port);
  content.numbers(sensor.origin.x, sensor.origin.y, sensor.origin_z);
  content.shares_and_heights(sensor.layers_share_lines, sensor.ground, sensor.moved);
  content.azimuths(sensor);
  content.length(sensor.range);
  content.numbers(sensor.range_min_mm, sensor.precision_mm, sensor.no_return_clears_mm);
  content.numbers(sensor.scan_width_ticks, sensor.max_points_per_scan);
  content.truth(sensor.is_synchronised);
  content.numbers(sensor.latency_us);
  visit_layers(content, sensor);
  content.numbers(sensor.columns_per_turn, sensor.column_ns);
  visit_profile(content, sensor.profile);
  content.arc(sensor.format, sensor.arc);
}

void visit_window(auto& content, auto& rules) {
  content.below(4, rules.discounting);
  content.below(2, rules.weighing);
  content.moved_tables_and_extent(rules.moved, rules.tables, rules.extent);
  content.numbers(rules.group_budget);
  content.assignment(rules.assignment);
}

void visit_tables(auto& content, auto& tables) {
  for (std::size_t bit = 0; bit < tables.decays.dynamic.size(); ++bit) {
    content.numbers(tables.decays.dynamic[bit], tables.decays.fixed[bit],
                    tables.decays.shared[bit]);
  }
  content.numbers(tables.accumulation.full_ms, tables.accumulation.empty_ms,
                  tables.accumulation.specialisations_per_second, tables.hit_mass);
  for (std::size_t ms = 1; ms < tables.free.size(); ++ms) {
    content.numbers(tables.free[ms]);
  }
}

// The grid's dimensions come first because the tables that follow use the grid's subcells as their
// unit.
void visit_car(auto& content, auto& car) {
  content.grid(car.grid);
  content.text(car.name);
  content.numbers(car.footprint.x_min, car.footprint.x_max);
  content.numbers(car.footprint.y_min, car.footprint.y_max, car.z_min, car.z_max);
  content.below(2, car.rule);
  content.quantisation_and_epsilon(car.quantisation, car.epsilon_e5);
  content.numbers(car.frame_period_us);
  content.grids_and_objects(car.grids, car.has_objects);
  content.numbers(car.poses.source_ipv4, car.poses.udp_port, car.poses.log2_slice_ms);
  content.numbers(car.maps.source_ipv4, car.maps.udp_port);
  visit_window(content, car.window);
  content.sensors(car.sensors, [&](auto& sensor) { visit_sensor(content, sensor); });
}

void visit_assignment(auto& content, auto& assignment) {
  for (std::size_t i = 0; i < evidence::kGradedIndexes; ++i) {
    content.numbers(assignment.occupied[i], assignment.free[i]);
  }
  content.numbers(assignment.free_by_time);
}

// Serialises the members of a car. Integers are written in big-endian byte order, at the full width
// of their type. A bool is written as one byte, a string as its characters followed by a 0, and a
// format as its name. `put(std::uint8_t)` receives the bytes one by one.
template <typename Put>
class Writer {
 public:
  explicit Writer(Put put) : put_(std::move(put)) {}

  [[nodiscard]] static bool ok() { return true; }

  void numbers(std::integral auto... values) { (number(values), ...); }
  void truth(bool value) { number(static_cast<std::uint8_t>(value ? 1 : 0)); }
  // Writes a byte with three flags, followed by the limits that are set. The flags indicate whether
  // the layers share lines, whether the sensor follows the ground, and whether the sensor has
  // limits for low beams and tall returns.
  void shares_and_heights(bool layers_share_lines, const vehicle::GroundLimits& ground,
                          const vehicle::MovedLimits& moved) {
    const unsigned shares = layers_share_lines ? 1U : 0U;
    const unsigned follows = ground.is_followed() ? 2U : 0U;
    const unsigned opens = moved.are_given() ? 4U : 0U;
    number(static_cast<std::uint8_t>(shares | follows | opens));
    if (ground.is_followed()) {
      numbers(ground.low_mm, ground.top_mm);
    }
    if (moved.are_given()) {
      numbers(moved.low_mm, moved.tall_mm);
    }
  }
  // An extra bit is set if the grids have classes but objects are not tracked.
  void grids_and_objects(vehicle::Grids grids, bool has_objects) {
    const bool is_off = vehicle::have_classes(grids) && !has_objects;
    number(static_cast<std::uint8_t>(static_cast<unsigned>(grids) | (is_off ? 4U : 0U)));
  }
  // If epsilon differs from the default, an extra bit is set and epsilon follows.
  void quantisation_and_epsilon(index::Quantisation quantisation, std::uint16_t epsilon_e5) {
    const bool is_usual = epsilon_e5 == vehicle::kUsualEpsilonE5;
    number(static_cast<std::uint8_t>(static_cast<unsigned>(quantisation) | (is_usual ? 0U : 2U)));
    if (!is_usual) {
      number(epsilon_e5);
    }
  }
  // An extra bit is set if evidential constants follow. A second extra bit is set if the window is
  // smaller than its maximum size.
  void moved_tables_and_extent(perception::Moved moved, const ageing::Tables* tables,
                               window::Extent extent) {
    const unsigned has_tables = tables == nullptr ? 0U : 2U;
    const unsigned is_smaller = extent == window::Extent{} ? 0U : 4U;
    number(static_cast<std::uint8_t>(static_cast<unsigned>(moved) | has_tables | is_smaller));
    if (tables != nullptr) {
      visit_tables(*this, *tables);
    }
    if (is_smaller != 0) {
      numbers(extent.columns, extent.rows);
    }
  }
  void below(unsigned /*count*/, auto value) { number(static_cast<std::uint8_t>(value)); }
  void text(std::string_view text) {
    for (const char letter : text) {
      number(static_cast<std::uint8_t>(letter));
    }
    number(std::uint8_t{0});
  }
  void format(lidar::Format format) { text(lidar::name_of(format)); }
  // Only radars and ultrasonic sensors have an arc.
  void arc(lidar::Format format, const sensor_model::Arc& arc) {
    if (lidar::facts_of(format).is_ultrasonic) {
      visit_cone(*this, arc);
    } else if (lidar::facts_of(format).is_radar) {
      visit_arc(*this, arc);
    }
  }
  void length(const traversal::LineLength& length) { number(length.mm()); }
  void azimuths(const vehicle::Sensor& sensor) {
    numbers(sensor.azimuths.ticks_per_turn(), sensor.azimuths.steps_per_turn());
  }
  // If the grid differs from the default grid in more than its cell size, the number of cells per
  // side is written as 0, and the rectangle is appended.
  void grid(const geometry::Grid& grid) {
    const std::uint16_t side = grid.is_whole() ? geometry::kCellsPerSide : 0;
    numbers(grid.cell_mm, side, std::uint16_t{geometry::kResolution});
    if (!grid.is_whole()) {
      numbers(grid.columns, grid.rows, grid.origin_column, grid.origin_row);
    }
  }
  void assignment(const evidence::Assignment* assignment) {
    truth(assignment != nullptr);
    if (assignment != nullptr) {
      visit_assignment(*this, *assignment);
    }
  }
  void sensors(std::span<const vehicle::Sensor> sensors, auto&& visit) {
    number(static_cast<std::uint8_t>(sensors.size()));
    for (const vehicle::Sensor& sensor : sensors) {
      visit(sensor);
    }
  }

 private:
  void number(std::integral auto value) {
    const std::uint64_t bits = static_cast<std::make_unsigned_t<decltype(value)>>(value);
    for (std::size_t byte = sizeof value; byte-- > 0;) {
      put_(static_cast<std::uint8_t>(bits >> (8 * byte)));
    }
  }

  Put put_;
};

}  // namespace content_detail

// Serialises the car and calls put(std::uint8_t) for each byte.
void write_content(const vehicle::Vehicle& car, auto&& put) {
  content_detail::Writer out([&put](std::uint8_t byte) { put(byte); });
  content_detail::visit_car(out, car);
}

// Returns the CRC-32 that identifies a car in messages. The CRC covers everything except `id`
// itself.
inline std::uint32_t identity_of(const vehicle::Vehicle& car) {
  using Field = checksum::ReflectedField<0x04C11DB7>;
  std::uint32_t state = ~0U;
  write_content(car, [&state](std::uint8_t byte) { state = Field::times_x8(state ^ byte); });
  return ~state;
}

}  // namespace iog::car_block
