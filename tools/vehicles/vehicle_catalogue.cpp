#include "tools/vehicles/vehicle_catalogue.hpp"

#include <algorithm>
#include <deque>

#include "tools/program/exit_status.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/program/joined.hpp"
#include "tools/vehicles/car_file.hpp"
#include "tools/vehicles/carried_cars.hpp"

namespace iog::tools {
namespace {

CatalogueEntry entry_of(const Car& car) {
  return {.vehicle = &car.vehicle,
          .description = &car.description,
          .sensors = car.sensors,
          .network = &car.network,
          .key_file = car.key_file};
}

struct Catalogue {
  Catalogue() {
    for (const CarriedCar& car : carried_cars()) {
      entries.push_back(entry_of(carried.emplace_back(parse_car(car.text, std::string(car.file)))));
    }
  }

  std::deque<Car> carried;
  std::deque<Car> of_files;
  std::vector<CatalogueEntry> entries;
  std::vector<std::string> given;  // those that the user has named, or has given the file of
};

Catalogue& catalogue() {
  static Catalogue all;
  return all;
}

}  // namespace

std::span<const CatalogueEntry> all_vehicles() { return catalogue().entries; }

std::string vehicle_names() {
  return joined(all_vehicles(), ", ",
                [](const CatalogueEntry& entry) { return entry.vehicle->name; });
}

const CatalogueEntry& find_vehicle(std::string_view name) {
  const auto all = all_vehicles();
  const auto found = std::ranges::find_if(
      all, [&](const CatalogueEntry& entry) { return entry.vehicle->name == name; });
  if (found == all.end() && name.ends_with(".toml")) {
    throw UsageError(std::string(name) +
                     ": a car's file: give --vehicle-file instead of --vehicle");
  }
  if (found == all.end()) {
    throw UsageError("no vehicle '" + std::string(name) + "'; the known ones are " +
                     vehicle_names());
  }
  return *found;
}

const CatalogueEntry* vehicle_of_id(std::uint32_t vehicle_id) {
  const auto all = all_vehicles();
  const auto found = std::ranges::find_if(
      all, [&](const CatalogueEntry& entry) { return entry.vehicle->id == vehicle_id; });
  return found == all.end() ? nullptr : &*found;
}

std::string words_of_vehicle(std::uint32_t vehicle_id) {
  const CatalogueEntry* const car = vehicle_of_id(vehicle_id);
  std::string words = car != nullptr
                          ? std::string(car->vehicle->name)
                          : "unknown car " + hex(vehicle_id) + ", --vehicle-file gives it";
  for (const std::string& given : catalogue().given) {
    if (find_vehicle(given).vehicle->id != vehicle_id) {
      words += "; not the " + given + " that was given";
    }
  }
  return words;
}

std::string add_vehicle_file(const std::string& path) {
  Catalogue& all = catalogue();
  const Car& car = all.of_files.emplace_back(read_car(path));
  std::erase_if(all.entries, [&](const CatalogueEntry& entry) {
    return entry.vehicle->name == car.description.name;
  });
  all.entries.push_back(entry_of(car));
  all.given.emplace_back(car.description.name);
  return std::string(car.description.name);
}

bool is_of_file(const CatalogueEntry& entry) {
  return std::ranges::any_of(catalogue().of_files,
                             [&](const Car& car) { return entry.vehicle == &car.vehicle; });
}

bool is_carried(std::uint32_t vehicle_id) {
  return std::ranges::any_of(catalogue().carried,
                             [&](const Car& car) { return car.vehicle.id == vehicle_id; });
}

void give_vehicle(const std::string& name) {
  catalogue().given.emplace_back(find_vehicle(name).vehicle->name);
}

std::size_t sensor_of_port(const CatalogueEntry& entry, std::uint16_t udp_port) {
  const auto found =
      std::ranges::find(entry.sensors, udp_port, &description::SensorConfig::udp_port);
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

std::vector<std::uint16_t> ports_of(const CatalogueEntry& entry) {
  std::vector<std::uint16_t> ports;
  for (const description::SensorConfig& sensor : entry.sensors) {
    ports.push_back(sensor.udp_port);
  }
  if (vehicle::have_classes(entry.vehicle->grids)) {
    ports.push_back(entry.vehicle->poses.udp_port);
    ports.push_back(entry.vehicle->maps.udp_port);
  }
  return ports;
}

bool is_pose_port(const CatalogueEntry& entry, std::uint16_t udp_port) {
  return vehicle::have_classes(entry.vehicle->grids) && udp_port == entry.vehicle->poses.udp_port;
}

bool is_map_port(const CatalogueEntry& entry, std::uint16_t udp_port) {
  return vehicle::have_classes(entry.vehicle->grids) && udp_port == entry.vehicle->maps.udp_port;
}

bool takes_port(const CatalogueEntry& entry, std::uint16_t udp_port) {
  return sensor_of_port(entry, udp_port) < entry.sensors.size() || is_pose_port(entry, udp_port) ||
         is_map_port(entry, udp_port);
}

}  // namespace iog::tools
