#include "tools/vehicle_header/header_text.hpp"

#include <array>
#include <charconv>
#include <concepts>
#include <sstream>

namespace iog::tools {
namespace {

// The shortest text that is this number again.
std::string number(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

std::string number(std::integral auto value) { return std::to_string(value); }

std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

// An enumerator by its number.
std::string of_type(std::string_view type, auto value) {
  return std::string(type) + '(' + std::to_string(static_cast<unsigned>(value)) + ')';
}

std::string truth(bool value) { return value ? "true" : "false"; }

std::string text_of(const vehicle::MountConfig& mount) {
  return "{.x_m = " + number(mount.x_m) + ", .y_m = " + number(mount.y_m) +
         ", .z_m = " + number(mount.z_m) + ", .yaw_deg = " + number(mount.yaw_deg) +
         ", .pitch_deg = " + number(mount.pitch_deg) + ", .roll_deg = " + number(mount.roll_deg) +
         '}';
}

std::string text_of(const lidar::Laser& laser) {
  return "lidar::Laser{" + number(laser.elevation_deg) + ", " + number(laser.azimuth_deg) + ", " +
         number(laser.height_m) + ", " + number(laser.range_m) + '}';
}

std::string text_of(const evidence::Assignment* assignment) {
  if (assignment == &evidence::kReinforced) {
    return "&evidence::kReinforced";
  }
  return assignment == &evidence::kIsopignistic ? "&evidence::kIsopignistic" : "nullptr";
}

std::string lasers_name(std::size_t sensor) { return "kLasers" + std::to_string(sensor); }

void write_lasers(std::ostream& out, const Car& car) {
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    if (!car.sensors[i].lasers.empty()) {
      out << "inline constexpr std::array " << lasers_name(i) << "{\n";
      for (const lidar::Laser& laser : car.sensors[i].lasers) {
        out << "    " << text_of(laser) << ",\n";
      }
      out << "};\n";
    }
  }
}

void write_sensor(std::ostream& out, const Car& car, std::size_t which) {
  const vehicle::SensorConfig& sensor = car.sensors[which];
  out << "    vehicle::SensorConfig{\n        .name = " << quoted(sensor.name)
      << ",\n        .format = " << of_type("lidar::Format", sensor.format)
      << ",\n        .source_ipv4 = " << sensor.source_ipv4
      << ",\n        .udp_port = " << sensor.udp_port
      << ",\n        .mount = " << text_of(sensor.mount)
      << ",\n        .range_min_mm = " << sensor.range_min_mm
      << ",\n        .range_max_mm = " << sensor.range_max_mm
      << ",\n        .precision_mm = " << sensor.precision_mm
      << ",\n        .sigma_m = " << number(sensor.sigma_m)
      << ",\n        .no_return_clears_mm = " << sensor.no_return_clears_mm
      << ",\n        .scan_width_ticks = " << sensor.scan_width_ticks
      << ",\n        .azimuth_steps_per_turn = " << sensor.azimuth_steps_per_turn
      << ",\n        .max_points_per_scan = " << sensor.max_points_per_scan
      << ",\n        .lasers = " << (sensor.lasers.empty() ? "{}" : lasers_name(which))
      << ",\n        .mode = {" << sensor.mode.columns_per_turn << ", "
      << sensor.mode.turns_per_second
      << "},\n        .beam_tilt_deg = " << number(sensor.beam_tilt_deg)
      << ",\n        .is_synchronised = " << truth(sensor.is_synchronised)
      << ",\n        .latency_us = " << sensor.latency_us << "},\n";
}

void write_description(std::ostream& out, const vehicle::Description& car) {
  out << "inline constexpr vehicle::Description kDescription{\n    .name = " << quoted(car.name)
      << ",\n    .footprint = {.x_min_m = " << number(car.footprint.x_min_m)
      << ", .x_max_m = " << number(car.footprint.x_max_m)
      << ", .y_min_m = " << number(car.footprint.y_min_m)
      << ", .y_max_m = " << number(car.footprint.y_max_m) << "}"
      << ",\n    .z_min_m = " << number(car.z_min_m) << ",\n    .z_max_m = " << number(car.z_max_m)
      << ",\n    .epsilon = " << number(car.epsilon)
      << ",\n    .quantisation = " << of_type("index::Quantisation", car.quantisation)
      << ",\n    .rule = " << of_type("vehicle::FusionRule", car.rule)
      << ",\n    .frame_period_us = " << car.frame_period_us
      << ",\n    .grids = " << of_type("vehicle::Grids", car.grids)
      << ",\n    .poses = {.source_ipv4 = " << car.poses.source_ipv4
      << ", .udp_port = " << car.poses.udp_port
      << ", .log2_slice_ms = " << number(car.poses.log2_slice_ms) << "}"
      << ",\n    .maps = {.source_ipv4 = " << car.maps.source_ipv4
      << ", .udp_port = " << car.maps.udp_port << "}"
      << ",\n    .window = {.discounting = "
      << of_type("ageing::Discounting", car.window.discounting)
      << ", .weighing = " << of_type("ageing::Weighing", car.window.weighing)
      << ", .assignment = " << text_of(car.window.assignment)
      << ", .moved = " << of_type("window::Moved", car.window.moved)
      << ", .group_budget = " << car.window.group_budget << "},\n};\n";
}

void write_network(std::ostream& out, const net::Config& network) {
  out << "inline constexpr net::Config kNetwork{\n    .mac = {{";
  for (const std::uint8_t octet : network.mac.octets) {
    out << number(octet) << ", ";
  }
  out << "}},\n    .address = {" << network.address.value
      << "},\n    .prefix_bits = " << number(network.prefix_bits) << ",\n    .peer = {"
      << network.peer.value << "},\n    .peer_port = " << network.peer_port
      << ",\n    .source_port = " << network.source_port << ",\n};\n";
}

}  // namespace

std::string header_of(const Car& car, const std::string& source) {
  std::ostringstream out;
  out << "// Generated from vehicles/" << source << " by tools/vehicle_header.\n#pragma once\n\n"
      << "#include <array>\n\n#include \"net/config.hpp\"\n#include \"vehicle/vehicle.hpp\"\n\n"
      << "namespace iog::vehicles::" << car.description.name << " {\n\n";
  write_lasers(out, car);
  out << "inline constexpr std::array kSensorConfigs{\n";
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    write_sensor(out, car, i);
  }
  out << "};\n\n";
  write_description(out, car.description);
  out << '\n';
  write_network(out, car.network);
  out << "\nextern const vehicle::Vehicle kVehicle;\n\n}  // namespace iog::vehicles::"
      << car.description.name << '\n';
  return out.str();
}

}  // namespace iog::tools
