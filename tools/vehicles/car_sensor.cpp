#include "tools/vehicles/car_sensor.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/car/defaults.hpp"
#include "tools/car/scanners.hpp"
#include "tools/car/tables.hpp"
#include "tools/vehicles/car_words.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {
namespace {

description::MountConfig read_mount(TomlTable table) {
  description::MountConfig mount;
  table.read("x_m", mount.x_m);
  table.read("y_m", mount.y_m);
  table.read("z_m", mount.z_m);
  table.read("yaw_deg", mount.yaw_deg);
  table.read("pitch_deg", mount.pitch_deg);
  table.read("roll_deg", mount.roll_deg);
  table.demand({"x_m", "y_m", "z_m"});
  table.refuse_others();
  return mount;
}

std::vector<lidar::Laser> read_lasers(std::vector<TomlTable> tables) {
  std::vector<lidar::Laser> lasers;
  for (TomlTable& table : tables) {
    lidar::Laser laser;
    table.read("elevation_deg", laser.elevation_deg);
    table.read("azimuth_deg", laser.azimuth_deg);
    table.read("height_m", laser.height_m);
    table.read("range_m", laser.range_m);
    table.demand({"elevation_deg"});
    table.refuse_others();
    lasers.push_back(laser);
  }
  return lasers;
}

// Evenly from the lowest to the highest. Wrong layers become one laser, so that only the wrong key
// is reported.
std::vector<lidar::Laser> read_layers(TomlTable table) {
  double from_deg = 0;
  double to_deg = 0;
  std::uint32_t count = 1;
  table.read("from_deg", from_deg);
  table.read("to_deg", to_deg);
  table.read("count", count);
  table.demand({"from_deg", "to_deg", "count"});
  table.refuse_others();
  if (count == 0 || count > vehicle::kMaxLayers) {
    table.refuse("count", "a whole number from 1 to " + std::to_string(vehicle::kMaxLayers));
    count = 1;
  }
  if (count > 1 && !(from_deg < to_deg)) {
    table.refuse("to_deg", "an elevation above from_deg");
    count = 1;
  }
  std::vector<lidar::Laser> lasers;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double share = count == 1 ? 0 : static_cast<double>(i) / (count - 1);
    lasers.push_back({.elevation_deg = from_deg + (to_deg - from_deg) * share});
  }
  return lasers;
}

description::GroundConfig read_ground(TomlTable table, double top_m) {
  description::GroundConfig ground{.top_m = top_m};
  table.read("low_m", ground.low_m);
  table.read("top_m", ground.top_m);
  table.refuse_others();
  return ground;
}

description::MovedConfig read_moved(TomlTable table,
                                    const std::optional<description::GroundConfig>& ground) {
  description::MovedConfig moved = description::usual_moved(ground);
  table.read("low_m", moved.low_m);
  table.read("tall_m", moved.tall_m);
  table.refuse_others();
  return moved;
}

// What the type of a scanner gives; another value changes that one member.
description::SensorConfig read_type(TomlTable& table) {
  using description::kScannerTypes;
  std::vector<std::string_view> names(kScannerTypes.size());
  std::ranges::transform(kScannerTypes, names.begin(), &description::ScannerType::name);
  const std::optional<std::size_t> chosen = table.read_word("type", names);
  if (!chosen) {
    return {};
  }
  description::SensorConfig sensor = description::scanner_of(kScannerTypes[*chosen].format);
  sensor.udp_port = description::usual_port(names[*chosen]);
  return sensor;
}

}  // namespace

void read_source(TomlTable& table, std::uint32_t& source_ipv4) {
  net::Ipv4Address address{source_ipv4};
  table.read("source_ipv4", address);
  source_ipv4 = address.value;
}

void read_sensor(TomlTable& table, Car& car) {
  description::SensorConfig sensor = read_type(table);
  table.read("name", car.names.emplace_back());
  sensor.name = car.names.back();
  read_source(table, sensor.source_ipv4);
  table.read("udp_port", sensor.udp_port);
  sensor.mount = read_mount(table.table("mount"));
  table.read("range_min_mm", sensor.range_min_mm);
  sensor.range_max_mm =
      description::usual_range_max_mm(sensor, description::grid_of(car.description.grid).cell_mm);
  table.read("range_max_mm", sensor.range_max_mm);
  table.read("precision_mm", sensor.precision_mm);
  table.read("sigma_m", sensor.sigma_m);
  table.read("azimuth_sigma_deg", sensor.azimuth_sigma_deg);
  table.read("no_return_clears_mm", sensor.no_return_clears_mm);
  table.read("scan_width_ticks", sensor.scan_width_ticks);
  table.read("azimuth_steps_per_turn", sensor.azimuth_steps_per_turn);
  table.read("max_points_per_scan", sensor.max_points_per_scan);
  table.read("mode", sensor.mode, kModeWords);
  table.read("beam_tilt_deg", sensor.beam_tilt_deg);
  auto& lasers = car.lasers.emplace_back(read_lasers(table.tables("lasers")));
  if (table.has("layers")) {
    std::ranges::copy(read_layers(table.table("layers")), std::back_inserter(lasers));
  }
  sensor.lasers = lasers;
  table.read("is_synchronised", sensor.is_synchronised);
  table.read("latency_us", sensor.latency_us);
  sensor.ground = description::usual_ground(sensor);
  if (table.is_false("ground")) {
    sensor.ground.reset();
  } else if (table.has("ground")) {
    sensor.ground = read_ground(table.table("ground", "false, or a table such as { low_m = 0.22 }"),
                                description::top_m_over(sensor.mount.z_m));
  }
  if (!table.is_false("moved") && table.has("moved")) {
    sensor.moved = read_moved(table.table("moved", "false, or a table such as { low_m = 0.7 }"),
                              sensor.ground);
  }
  table.demand({"name", "type", "mount"});
  table.refuse_others();
  car.sensors.push_back(sensor);
}

}  // namespace iog::tools
