#include "tools/vehicles/vehicle_catalogue.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "stream/crc32.hpp"
#include "tools/program/exit_status.hpp"
#include "vehicles/reference_car.hpp"
#include "vehicles/roof_vlp16.hpp"
#include "vehicles/two_lux_parking.hpp"

namespace iog::tools {
namespace {

constexpr std::array kCatalogue{
    CatalogueEntry{&vehicles::reference_car::kVehicle, &vehicles::reference_car::kDescription,
                   vehicles::reference_car::kSensorConfigs},
    CatalogueEntry{&vehicles::roof_vlp16::kVehicle, &vehicles::roof_vlp16::kDescription,
                   vehicles::roof_vlp16::kSensorConfigs},
    CatalogueEntry{&vehicles::two_lux_parking::kVehicle, &vehicles::two_lux_parking::kDescription,
                   vehicles::two_lux_parking::kSensorConfigs},
};

std::string known_names() {
  std::string names;
  for (const CatalogueEntry& entry : kCatalogue) {
    names += (names.empty() ? "" : ", ") + std::string(entry.vehicle->name);
  }
  return names;
}

}  // namespace

std::span<const CatalogueEntry> all_vehicles() { return kCatalogue; }

const CatalogueEntry& find_vehicle(std::string_view name) {
  const auto* const found = std::ranges::find_if(
      kCatalogue, [&](const CatalogueEntry& entry) { return entry.vehicle->name == name; });
  if (found == kCatalogue.end()) {
    throw UsageError("no vehicle '" + std::string(name) + "'; the known ones are " + known_names());
  }
  return *found;
}

const CatalogueEntry* vehicle_of_id(std::uint32_t vehicle_id) {
  const auto* const found = std::ranges::find_if(kCatalogue, [&](const CatalogueEntry& entry) {
    stream::Crc32 crc;
    crc.update(std::as_bytes(std::span(entry.vehicle->name)));
    return crc.value() == vehicle_id;
  });
  return found == kCatalogue.end() ? nullptr : found;
}

std::size_t sensor_of_port(const CatalogueEntry& entry, std::uint16_t udp_port) {
  const auto found = std::ranges::find(entry.sensors, udp_port, &vehicle::SensorConfig::udp_port);
  return static_cast<std::size_t>(found - entry.sensors.begin());
}

std::size_t sensor_of_name(const CatalogueEntry& entry, std::string_view name) {
  for (std::size_t i = 0; i < entry.sensors.size(); ++i) {
    if (entry.sensors[i].name == name || std::to_string(i) == name) {
      return i;
    }
  }
  return entry.sensors.size();
}

std::string vehicle_option_help() { return "The car and its sensors: " + known_names(); }

}  // namespace iog::tools
