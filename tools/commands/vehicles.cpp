// iog vehicles: the vehicle descriptions and their sensors.
#include <CLI/CLI.hpp>
#include <iomanip>
#include <iostream>
#include <memory>
#include <string>

#include "tools/commands/subcommands.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

void show_all() {
  for (const CatalogueEntry& entry : all_vehicles()) {
    std::cout << entry.vehicle->name << '\n';
    for (const vehicle::SensorConfig& sensor : entry.sensors) {
      const vehicle::MountConfig& mount = sensor.mount;
      std::cout << "  " << std::left << std::setw(14) << sensor.name << " UDP " << sensor.udp_port
                << ", x " << mount.x_m << " m, y " << mount.y_m << " m, z " << mount.z_m
                << " m, yaw " << mount.yaw_deg << " deg, up to " << sensor.range_max_mm / 1000.0
                << " m\n";
    }
  }
}

void show_ports(const std::string& name) {
  for (const vehicle::SensorConfig& sensor : find_vehicle(name).sensors) {
    std::cout << sensor.udp_port << '\n';
  }
}

}  // namespace

void add_vehicles(CLI::App& program) {
  auto* const command = program.add_subcommand("vehicles", "List the vehicles and their sensors");
  const auto name = std::make_shared<std::string>();
  command->add_option("--ports", *name,
                      "Only the UDP ports of this vehicle's sensors, one a line, for scripts");
  command->callback([name] { name->empty() ? show_all() : show_ports(*name); });
}

}  // namespace iog::tools
