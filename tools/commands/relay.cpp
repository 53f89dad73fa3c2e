// iog relay: the scans of ibeo units, which send over TCP, as the datagrams that a target takes.
#include "tools/relay/relay.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tools/commands/subcommands.hpp"
#include "tools/commands/vehicle_options.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/program/add_option.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/interrupt.hpp"
#include "tools/replay/udp_sender.hpp"
#include "tools/vehicles/network_words.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

struct RelayOptions {
  std::string vehicle = kDefaultVehicle;
  std::string target;
  std::uint16_t port_base = 0;  // 0: the vehicle's own ports
  std::vector<std::string> units;
};

// "roof=10.0.0.5:12002" or without the port.
RelayedUnit unit_in(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw UsageError("--unit " + text + ": give a sensor's name, = and the unit's IPv4 address");
  }
  RelayedUnit unit{.name = text.substr(0, equals), .host = text.substr(equals + 1)};
  const std::size_t colon = unit.host.find(':');
  if (colon == std::string::npos) {
    return unit;
  }
  const std::string port = unit.host.substr(colon + 1);
  const char* const end = port.data() + port.size();
  const auto read = std::from_chars(port.data(), end, unit.tcp_port);
  if (read.ec != std::errc() || read.ptr != end || unit.tcp_port == 0) {
    throw UsageError("--unit " + text + ": its TCP port is one of 1 ... 65535");
  }
  unit.host.resize(colon);
  return unit;
}

struct Plan {
  std::vector<RelayedUnit> units;
  std::vector<std::uint16_t> ports;  // of the target, by unit
};

RelayedUnit described_unit(const description::SensorConfig& sensor) {
  if (sensor.source_ipv4 == 0) {
    throw UsageError("sensor " + std::string(sensor.name) + " has no address: give --unit " +
                     std::string(sensor.name) + "=ADDRESS");
  }
  return {.name = std::string(sensor.name), .host = dotted(sensor.source_ipv4)};
}

// Every unit of the car that sends over TCP, or those alone that are given.
Plan plan_of(const RelayOptions& options, const CatalogueEntry& car) {
  Plan plan;
  const auto add = [&](std::size_t sensor, RelayedUnit unit) {
    const std::size_t port =
        options.port_base == 0 ? car.sensors[sensor].udp_port : options.port_base + sensor;
    if (port > 0xFFFF) {
      throw UsageError("--port-base leaves no room for the car's sensors; give a lower one");
    }
    plan.ports.push_back(static_cast<std::uint16_t>(port));
    plan.units.push_back(std::move(unit));
  };
  for (const std::string& text : options.units) {
    RelayedUnit unit = unit_in(text);
    const std::size_t sensor = sensor_of_name(car, unit.name);
    if (sensor == car.sensors.size() || !sends_lux_scans(car.sensors[sensor].format)) {
      throw UsageError("--unit " + text + ": " + options.vehicle + " has no ibeo unit " +
                       unit.name);
    }
    add(sensor, std::move(unit));
  }
  for (std::size_t i = 0; options.units.empty() && i < car.sensors.size(); ++i) {
    if (sends_lux_scans(car.sensors[i].format)) {
      add(i, described_unit(car.sensors[i]));
    }
  }
  if (plan.units.empty()) {
    throw UsageError(options.vehicle + " has no ibeo unit, and others send datagrams themselves");
  }
  return plan;
}

void relay(const RelayOptions& options) {
  constexpr std::chrono::milliseconds kLookAround{100};  // for units that have to be tried again
  const CatalogueEntry& car = find_vehicle(options.vehicle);
  Plan plan = plan_of(options, car);
  UdpSender sender(options.target.empty() ? dotted(car.network->address.value) : options.target,
                   plan.ports);
  Relay relay(
      std::move(plan.units),
      [&](std::size_t unit, std::span<const std::byte> datagram) {
        return sender.send(unit, datagram);
      },
      [](const std::string& line) { std::cout << line << std::endl; });
  while (!was_interrupted()) {
    relay.wait(kLookAround);
  }
  for (std::size_t unit = 0; unit < relay.size(); ++unit) {
    std::cout << relay.words_of(unit) << '\n';
  }
  sender.demand_sent();
}

}  // namespace

void add_relay(CLI::App& program) {
  auto* const command = program.add_subcommand(
      "relay", "Read a car's ibeo units by TCP and send their scans to a target");
  const auto options = std::make_shared<RelayOptions>();
  add_vehicle_options(*command, options->vehicle);
  add_option(*command, "--target", "ADDRESS  (default the car's)", options->target,
             "IPv4 address to send to");
  add_option(*command, "--port-base", "PORT", options->port_base,
             "First of consecutive ports that replace those of the car's sensors")
      ->check(CLI::Range(1, 65'535));
  add_option(*command, "--unit", "NAME=ADDRESS[:PORT] ...", options->units,
             "Connect to these sensors only, at these addresses; default TCP port 12002");
  command->footer(
      "relay connects to ibeo LUX and SICK LD-MRS units, which are TCP servers. Without --unit, it "
      "uses the source_ipv4 of each sensor in the car file. It sends nothing to a unit, which must "
      "already be set up to measure. It restores lost connections until interrupted. A target "
      "accepts packets from a sensor's source_ipv4 and from its peer. So run relay on the peer, or "
      "name this host as source_ipv4 in the car file and give each --unit.");
  command->callback([options] {
    catch_interrupts();
    relay(*options);
  });
}

}  // namespace iog::tools
