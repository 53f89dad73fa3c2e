// What a car's file must keep to, beyond the limits of every description (vehicle/limits.hpp):
// names, places and addresses of a car that can be, and what a frame of it may mark.
//
// Of each check there is this one: the build asserts it, and the PC's tools tell what is wrong.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "description/reserved_names.hpp"
#include "geometry/grid.hpp"
#include "grid/pending_marks.hpp"
#include "net/config.hpp"
#include "vehicle/description.hpp"
#include "vehicle/fault.hpp"
#include "vehicle/limits.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::description {

using vehicle::Fault;
using vehicle::is_within;

inline constexpr std::size_t kLongestSensorName = 15;
inline constexpr std::size_t kLongestCarName = 31;

// How far a sensor may stand off its car: a bumper, a roof rack.
inline constexpr double kOffCarM = 0.15;

namespace detail {

// Letters, digits and '_', of which the first is a letter.
constexpr bool is_name(std::string_view name, std::size_t longest) {
  const auto is_allowed = [](char c) {
    return is_within(c, 'a', 'z') || is_within(c, 'A', 'Z') || is_within(c, '0', '9') || c == '_';
  };
  return !name.empty() && name.size() <= longest && !is_within(name.front(), '0', '9') &&
         std::ranges::all_of(name, is_allowed);
}

constexpr double half_grid_m() { return geometry::kOriginCell * geometry::kCellMm / 1000.0; }

// A sensor's mount against the car, and the car against the grid.
constexpr void check_place(const vehicle::Description& car, const vehicle::MountConfig& mount,
                           std::size_t number, auto&& tell) {
  const vehicle::FootprintConfig& its = car.footprint;
  if (!is_within(mount.x_m, its.x_min_m - kOffCarM, its.x_max_m + kOffCarM)) {
    tell(Fault{number, "mount.x_m", "a place on the car: footprint.x_min_m ... x_max_m, 0.15 off"});
  }
  if (!is_within(mount.y_m, its.y_min_m - kOffCarM, its.y_max_m + kOffCarM)) {
    tell(Fault{number, "mount.y_m", "a place on the car: footprint.y_min_m ... y_max_m, 0.15 off"});
  }
  if (!is_within(mount.z_m, -kOffCarM, 10.0)) {
    tell(Fault{number, "mount.z_m", "a place on the car: -0.15 ... 10"});
  }
}

constexpr void check_footprint(const vehicle::FootprintConfig& its, auto&& tell) {
  const double half = half_grid_m();
  if (!is_within(its.x_min_m, -half, half) || !is_within(its.x_max_m, -half, half)) {
    tell(Fault{.field = "footprint.x_max_m", .allowed = "a car within the grid around its origin"});
  }
  if (!is_within(its.y_min_m, -half, half) || !is_within(its.y_max_m, -half, half)) {
    tell(Fault{.field = "footprint.y_max_m", .allowed = "a car within the grid around its origin"});
  }
}

// Whether any beam of the layer, from the sensor to the end of its range, is somewhere in the band.
constexpr bool meets_band(const vehicle::Sensor& sensor, const vehicle::Layer& layer,
                          std::int64_t z_min, std::int64_t z_max) {
  const auto size_of = [](std::int64_t value) { return value < 0 ? -value : value; };
  const std::int64_t unit = std::int64_t{1} << vehicle::kAxisFractionBits;
  const std::int64_t swing = size_of(layer.z.forward) + size_of(layer.z.left);
  const std::int64_t origin = sensor.origin_z * unit;
  return std::max(origin, layer.z.base + swing) >= z_min * unit &&
         std::min(origin, layer.z.base - swing) <= z_max * unit;
}

template <typename AnySensor>
constexpr bool is_sensor_address_taken(std::span<const AnySensor> sensors, std::size_t number,
                                       const net::Config& network) {
  const std::uint32_t address = sensors[number].source_ipv4;
  const auto others = sensors.first(number);
  return address != 0 &&
         (address == network.address.value ||
          std::ranges::find(others, address, &AnySensor::source_ipv4) != others.end());
}

constexpr bool is_source(std::uint32_t ipv4) { return ipv4 == 0 || net::is_host_address({ipv4}); }

}  // namespace detail

// Names, ports and addresses of which each sensor has its own. AnySensor: SensorConfig or Sensor.
template <typename AnySensor>
constexpr void check_own(std::span<const AnySensor> sensors, const net::Config& network,
                         auto&& tell) {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const AnySensor& sensor = sensors[i];
    const auto others = sensors.first(i);
    if (!detail::is_name(sensor.name, kLongestSensorName)) {
      tell(Fault{i, "name", "at most 15 letters, digits and '_', no digit first"});
    } else if (std::ranges::find(others, sensor.name, &AnySensor::name) != others.end()) {
      tell(Fault{i, "name", "a name that no other sensor has"});
    }
    if (std::ranges::find(others, sensor.udp_port, &AnySensor::udp_port) != others.end()) {
      tell(Fault{i, "udp_port", "a port that no other sensor has"});
    }
    if (detail::is_sensor_address_taken(sensors, i, network)) {
      tell(Fault{i, "source_ipv4", "an address that nobody else has"});
    } else if (!detail::is_source(sensor.source_ipv4)) {
      tell(Fault{i, "source_ipv4", "the address of one host, or 0.0.0.0 for any"});
    }
    if (sensor.latency_us > 1'000'000) {
      tell(Fault{i, "latency_us", "at most 1000000"});
    }
  }
}

constexpr void check_network(const net::Config& network, auto&& tell) {
  if (!is_within<unsigned>(network.prefix_bits, 8, 30)) {
    tell(Fault{.field = "network.prefix_bits", .allowed = "8 ... 30"});
    return;
  }
  if (!network.mac.is_unicast()) {
    tell(Fault{.field = "network.mac",
               .allowed = "the address of one station, its first octet even"});
  }
  if (!net::is_host_in_subnet(network.address, network.address, network.prefix_bits)) {
    tell(Fault{.field = "network.address", .allowed = "the address of a host of its subnet"});
  } else if (!net::is_host_in_subnet(network.peer, network.address, network.prefix_bits) ||
             network.peer == network.address) {
    tell(
        Fault{.field = "network.peer", .allowed = "another host of the subnet of network.address"});
  }
  if (network.peer_port == 0) {
    tell(Fault{.field = "network.peer_port", .allowed = "1 ... 65535"});
  }
  if (network.source_port == 0) {
    tell(Fault{.field = "network.source_port", .allowed = "1 ... 65535"});
  }
}

// Where the poses and the maps come from. AnyCar: Description or Vehicle, also below.
template <typename AnyCar>
constexpr void check_sources(const AnyCar& car, const net::Config& network, auto&& tell) {
  const auto is_allowed = [&](std::uint32_t ipv4) {
    return detail::is_source(ipv4) && ipv4 != network.address.value;
  };
  if (!is_allowed(car.poses.source_ipv4)) {
    tell(Fault{.field = "poses.source_ipv4",
               .allowed = "another host's address, or 0.0.0.0 for any"});
  }
  if (!is_allowed(car.maps.source_ipv4)) {
    tell(Fault{.field = "maps.source_ipv4",
               .allowed = "another host's address, or 0.0.0.0 for any"});
  }
}

// What a car is called, its frames, and how many sensors it has.
template <typename AnyCar>
constexpr void check_frames(const AnyCar& car, std::size_t sensors, auto&& tell) {
  if (!detail::is_name(car.name, kLongestCarName)) {
    tell(Fault{.field = "name", .allowed = "at most 31 letters, digits and '_', no digit first"});
  }
  if (!is_within<std::uint32_t>(car.frame_period_us, 10'000, 1'000'000)) {
    tell(Fault{.field = "frame_period_us", .allowed = "10000 ... 1000000"});
  }
  if (!is_within<std::uint32_t>(car.window.group_budget, 1, window::kGroupBudget)) {
    tell(Fault{.field = "window.group_budget", .allowed = "1 ... 65536"});
  }
  if (!is_within<std::size_t>(sensors, 1, vehicle::kMaxSensors)) {
    tell(Fault{.field = "sensors", .allowed = "1 ... 8 of them"});
  }
}

// Before its tables are computed.
constexpr void check_car(const vehicle::Description& car,
                         std::span<const vehicle::SensorConfig> sensors, const net::Config& network,
                         auto&& tell) {
  check_frames(car, sensors.size(), tell);
  if (is_reserved(car.name)) {
    tell(Fault{.field = "name",
               .allowed = "a name that C++ and the build do not have, without '__' and '_' first"});
  }
  detail::check_footprint(car.footprint, tell);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    detail::check_place(car, sensors[i].mount, i, tell);
  }
  check_own(sensors, network, tell);
  check_network(network, tell);
  check_sources(car, network, tell);
}

// Of the tables.
constexpr void check_tables(const vehicle::Vehicle& car, auto&& tell) {
  const auto marks_of = [](const vehicle::Sensor& sensor) {
    return std::uint64_t{sensor.max_points_per_scan} * grid::max_marks_per_point(sensor);
  };
  std::uint64_t all_marks = 0;
  for (const vehicle::Sensor& sensor : car.sensors) {
    all_marks += marks_of(sensor);
  }
  std::uint64_t marks_left = grid::kMaxMarks;  // endless once it has been told
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    const vehicle::Sensor& sensor = car.sensors[i];
    const auto layers = std::span(sensor.layers).first(sensor.layer_count);
    if (std::ranges::none_of(layers, [&](const vehicle::Layer& layer) {
          return detail::meets_band(sensor, layer, car.z_min, car.z_max);
        })) {
      tell(Fault{i, "mount.z_m", "a height and tilt of which some beam meets z_min_m ... z_max_m"});
    }
    const std::uint64_t marks = marks_of(sensor);
    if (marks > marks_left) {
      tell(Fault{i, "max_points_per_scan",
                 "fewer: all sensors together mark at most 262144 cells a frame", all_marks});
      marks_left = std::numeric_limits<std::uint64_t>::max();
    }
    marks_left -= marks;
  }
}

}  // namespace iog::description
