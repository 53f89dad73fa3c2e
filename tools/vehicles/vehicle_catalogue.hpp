// The vehicles that `iog` knows, by name: the same descriptions that the firmware is built from,
// and those of car files that it is given.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "net/config.hpp"
#include "tools/car/description.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {

struct CatalogueEntry {
  const vehicle::Vehicle* vehicle;
  const description::Description* description;         // in metres, as a person wrote it
  std::span<const description::SensorConfig> sensors;  // in the order of vehicle->sensors
  const net::Config* network;
  std::string_view key_file{};  // tools/vehicles/key_file.hpp; empty: the car has no key
};

[[nodiscard]] std::span<const CatalogueEntry> all_vehicles();
[[nodiscard]] std::string vehicle_names();  // "reference_car, robot_2d, ..."

// UsageError with the known names if there is no such vehicle.
[[nodiscard]] const CatalogueEntry& find_vehicle(std::string_view name);

// The vehicle of this content (stream::Header::vehicle_id); nullptr: an unknown one.
[[nodiscard]] const CatalogueEntry* vehicle_of_id(std::uint32_t vehicle_id);

// What to call the vehicle of a stream: its name, or that it is none of those known here; and which
// it is not of those that the user gave.
[[nodiscard]] std::string words_of_vehicle(std::uint32_t vehicle_id);

// Adds the car of a file, in place of one of the same name, and returns its name. UsageError with
// all its mistakes. References to entries end here: it is for the command line, before all else.
std::string add_vehicle_file(const std::string& path);

// Whether a user's file describes the car, and not this program.
[[nodiscard]] bool is_of_file(const CatalogueEntry& entry);

// Whether it is the content of a car of vehicles/, which has a firmware of its own.
[[nodiscard]] bool is_carried(std::uint32_t vehicle_id);

// The user expects a stream to be of the vehicle of that name. UsageError as find_vehicle().
void give_vehicle(const std::string& name);

// The sensor of that UDP port, or of that name or number; sensors.size() if there is none.
[[nodiscard]] std::size_t sensor_of_port(const CatalogueEntry& entry, std::uint16_t udp_port);
[[nodiscard]] std::size_t sensor_of_name(const CatalogueEntry& entry, std::string_view name);

// The UDP ports to which a vehicle's packets come: of its sensors in their order, of its poses and
// of its maps.
[[nodiscard]] std::vector<std::uint16_t> ports_of(const CatalogueEntry& entry);

// Whether poses for the vehicle come to that UDP port: only if its target sends classes.
[[nodiscard]] bool is_pose_port(const CatalogueEntry& entry, std::uint16_t udp_port);

// Likewise for maps.
[[nodiscard]] bool is_map_port(const CatalogueEntry& entry, std::uint16_t udp_port);

// Whether the vehicle takes what comes to that UDP port, from a sensor or from who sends poses or
// maps.
[[nodiscard]] bool takes_port(const CatalogueEntry& entry, std::uint16_t udp_port);

inline constexpr const char* kDefaultVehicle = "reference_car";

}  // namespace iog::tools
