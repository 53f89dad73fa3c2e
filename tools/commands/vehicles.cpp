// iog vehicles: the vehicle descriptions and their sensors.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/vehicles/car_words.hpp"
#include "tools/vehicles/grid_words.hpp"
#include "tools/vehicles/key_file.hpp"
#include "tools/vehicles/network_words.hpp"
#include "tools/vehicles/two_returns.hpp"
#include "tools/vehicles/unused_band.hpp"
#include "tools/vehicles/upward_mount.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

// "; obstacles are 0.22 to 2.2 m over the ground", "; ground is opened below 0.6 m"
std::string words_of_heights(const description::SensorConfig& sensor) {
  std::ostringstream words;
  if (sensor.ground) {
    words << "; obstacles are " << sensor.ground->low_m << " to " << sensor.ground->top_m
          << " m over the ground";
  }
  if (sensor.moved) {
    words << "; ground is opened below " << sensor.moved->low_m << " m";
  }
  return words.str();
}

// All, or only those of the files that were given.
void show_all() {
  const bool is_any_given = std::ranges::any_of(all_vehicles(), is_of_file);
  for (const CatalogueEntry& entry : all_vehicles()) {
    if (is_any_given && !is_of_file(entry)) {
      continue;
    }
    std::cout << entry.vehicle->name << '\n'
              << "  in a stream    " << hex(entry.vehicle->id) << '\n';
    if (entry.vehicle->grid != geometry::Grid{}) {
      std::cout << "  grid           " << words_of_grid(entry.vehicle->grid) << '\n';
    }
    if (entry.vehicle->window.extent != window::Extent{}) {
      std::cout << "  window         "
                << words_of_window(entry.vehicle->window.extent, entry.vehicle->grid.cell_mm)
                << '\n';
    }
    for (const description::SensorConfig& sensor : entry.sensors) {
      const description::MountConfig& mount = sensor.mount;
      std::cout << "  " << std::left << std::setw(14) << sensor.name << " UDP " << sensor.udp_port
                << ", x " << mount.x_m << " m, y " << mount.y_m << " m, z " << mount.z_m
                << " m, yaw " << mount.yaw_deg << " deg, pitch " << mount.pitch_deg << " deg, roll "
                << mount.roll_deg << " deg, up to " << sensor.range_max_mm / 1000.0 << " m"
                << words_of_heights(sensor) << '\n';
    }
    std::cout << warning_of_two_returns(entry) << warning_of_upward_mounts(entry)
              << warning_of_unused_band(entry)
              << warning_of_key_file(entry.vehicle->name, std::string(entry.key_file));
    if (vehicle::have_classes(entry.vehicle->grids)) {
      std::cout << "  " << std::left << std::setw(14) << "poses"
                << " UDP " << entry.vehicle->poses.udp_port << '\n'
                << "  " << std::left << std::setw(14) << "maps"
                << " UDP " << entry.vehicle->maps.udp_port << '\n';
    }
  }
}

void show_ports(const std::string& name) {
  for (const std::uint16_t port : ports_of(find_vehicle(name))) {
    std::cout << port << '\n';
  }
}

std::string_view placed_by(const vehicle::Vehicle& vehicle) {
  if (!vehicle::have_classes(vehicle.grids)) {
    return "none";
  }
  return vehicle.depends_on_arrival() ? "arrival" : "clocks";
}

// Its own if the build makes one, else that for cars of its kind.
void show_firmware(const std::string& name) {
  const vehicle::Vehicle& car = *find_vehicle(name).vehicle;
  std::cout << (is_carried(car.id) ? car.name : word_of(car.grids)) << '\n';
}

}  // namespace

void add_vehicles(CLI::App& program) {
  auto* const command = program.add_subcommand("vehicles", "List the cars and their sensors");
  const auto add = [command](const char* option, const char* text) {
    auto name = std::make_shared<std::string>();
    command->add_option(option, *name, text)->option_text("NAME")->check(known_vehicles());
    return name;
  };
  const auto name =
      add("--ports",
          "For scripts: UDP ports of the car's sensors, then of poses and maps, one per line");
  const auto connected = add("--network",
                             "For scripts: MAC, address and prefix bits of the target, address and "
                             "port of its peer, its own port");
  const auto asking = add("--grids", "For scripts: indexes, classes or both");
  const auto placed = add(
      "--placed-by",
      "For scripts: clocks, arrival (a sensor lacks the clock of the poses) or none (no classes)");
  const auto carried =
      add("--firmware", "For scripts: the firmware of the build that takes this car");
  add_vehicle_file_option(*command);
  command->callback([name, connected, asking, placed, carried] {
    if (!carried->empty()) {
      show_firmware(*carried);
    } else if (!asking->empty()) {
      std::cout << word_of(find_vehicle(*asking).vehicle->grids) << '\n';
    } else if (!placed->empty()) {
      std::cout << placed_by(*find_vehicle(*placed).vehicle) << '\n';
    } else if (!connected->empty()) {
      std::cout << network_line(*find_vehicle(*connected).network) << '\n';
    } else {
      name->empty() ? show_all() : show_ports(*name);
    }
  });
}

}  // namespace iog::tools
