// The vehicles that `iog` knows, by name: the same descriptions that the firmware is built from.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "vehicle/vehicle.hpp"

namespace iog::tools {

struct CatalogueEntry {
  const vehicle::Vehicle* vehicle;
  const vehicle::Description* description;         // in metres, as a person wrote it
  std::span<const vehicle::SensorConfig> sensors;  // in the order of vehicle->sensors
};

[[nodiscard]] std::span<const CatalogueEntry> all_vehicles();

// UsageError with the known names if there is no such vehicle.
[[nodiscard]] const CatalogueEntry& find_vehicle(std::string_view name);

// The vehicle whose name has this CRC-32 (stream::Header::vehicle_id); nullptr: an unknown one.
[[nodiscard]] const CatalogueEntry* vehicle_of_id(std::uint32_t vehicle_id);

// The sensor of that UDP port, or of that name or number; sensors.size() if there is none.
[[nodiscard]] std::size_t sensor_of_port(const CatalogueEntry& entry, std::uint16_t udp_port);
[[nodiscard]] std::size_t sensor_of_name(const CatalogueEntry& entry, std::string_view name);

// For --help: "--vehicle NAME" and the names that it takes.
inline constexpr const char* kDefaultVehicle = "reference_car";
[[nodiscard]] std::string vehicle_option_help();

}  // namespace iog::tools
