#include "tools/vehicles/vehicle_fit.hpp"

#include <filesystem>
#include <optional>
#include <utility>

#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/vehicles/unit_fit.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kNamedPorts = 8;  // more would hide what matters

std::string list_of(const PortCounts& ports) {
  std::string text;
  std::size_t named = 0;
  for (const auto& [port, count] : ports) {
    if (named++ == kNamedPorts) {
      return text + " and others";
    }
    text += (text.empty() ? "" : ", ") + std::to_string(port);
  }
  return text;
}

PortCounts sensor_ports_of(const CatalogueEntry& car) {
  PortCounts ports;
  for (const vehicle::SensorConfig& sensor : car.sensors) {
    ports[sensor.udp_port] = 0;
  }
  return ports;
}

// The vehicle whose sensors would get most of the packets; nullptr: none would get any.
const CatalogueEntry* best_fit(const PortCounts& ports) {
  const CatalogueEntry* best = nullptr;
  std::uint64_t most = 0;
  for (const CatalogueEntry& entry : all_vehicles()) {
    std::uint64_t packets = 0;
    for (const auto& [port, count] : ports) {
      packets += sensor_of_port(entry, port) < entry.sensors.size() ? count : 0;
    }
    if (packets > most) {
      most = packets;
      best = &entry;
    }
  }
  return best;
}

}  // namespace

std::string words_of_misfit(const CatalogueEntry& car, const PortCounts& ports) {
  std::string text = "no packet is for a sensor of " + std::string(car.vehicle->name) +
                     " (UDP port " + list_of(sensor_ports_of(car)) + "); ";
  if (ports.empty()) {
    return text + "it holds no UDP packet at all";
  }
  text += "its packets go to port " + list_of(ports);
  const CatalogueEntry* const other = best_fit(ports);
  return text + (other != nullptr ? ", as those of " + std::string(other->vehicle->name) +
                                        " do: try --vehicle " + std::string(other->vehicle->name)
                                  : "; `iog info FILE` says what they are");
}

void demand_fit(const std::string& path, const CatalogueEntry& car) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored)) {
    return;
  }
  PcapReader capture(path);
  PortCounts ports;
  UnitFit units(car);
  bool is_in_doubt = false;
  while (const std::optional<CapturedDatagram> datagram = capture.next()) {
    if (sensor_of_port(car, datagram->destination.port) == car.sensors.size()) {
      ++ports[datagram->destination.port];
      continue;
    }
    const UnitFit::Verdict verdict = units.take(*datagram);
    if (verdict == UnitFit::Verdict::kFits) {
      return;
    }
    if (verdict == UnitFit::Verdict::kOther) {
      throw UsageError(path + ": " + units.words());
    }
    is_in_doubt = true;
  }
  if (is_in_doubt) {
    throw UsageError(path + ": " + units.words());
  }
  const std::string skipped = describe_skipped(capture.counts());
  throw UsageError(path + ": " + words_of_misfit(car, ports) +
                   (skipped.empty() ? "" : " (" + skipped + ")"));
}

}  // namespace iog::tools
