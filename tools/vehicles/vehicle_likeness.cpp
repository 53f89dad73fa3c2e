#include "tools/vehicles/vehicle_likeness.hpp"

#include <algorithm>
#include <iterator>

#include "intake/packet.hpp"
#include "lidar/ibeo_lux.hpp"
#include "tools/formats/lux/lux_scan.hpp"

namespace iog::tools {
namespace {

// Of a port; they are all alike.
constexpr std::uint64_t kLookedAt = 400;

// The sensors that any vehicle has on the port.
std::vector<const vehicle::Sensor*> sensors_on(std::uint16_t udp_port) {
  std::vector<const vehicle::Sensor*> sensors;
  for (const CatalogueEntry& entry : all_vehicles()) {
    for (const vehicle::Sensor& sensor : entry.vehicle->sensors) {
      if (sensor.udp_port == udp_port) {
        sensors.push_back(&sensor);
      }
    }
  }
  return sensors;
}

// From one direction to the next, by the description of a LUX, whose scans have four layers: they
// and echoes share directions.
std::int32_t step_of(const vehicle::SensorConfig& sensor) {
  const auto directions =
      static_cast<std::int32_t>(sensor.max_points_per_scan / lidar::IbeoLux::kElevationsDeg.size() /
                                lidar::IbeoLux::kMaxEchoes);
  return directions > 1 ? sensor.scan_width_ticks / (directions - 1) : 0;
}

std::string degrees(std::int32_t ticks) {
  std::string text = std::to_string(360.0 * ticks / lidar::IbeoLux::kTicksPerTurn);
  return text.substr(0, text.find('.') + 3);
}

std::string joined(const std::vector<std::string>& reasons) {
  std::string text;
  for (const std::string& reason : reasons) {
    text += (text.empty() ? "" : "; ") + reason;
  }
  return text;
}

}  // namespace

void VehicleLikeness::add(const CapturedDatagram& datagram) {
  const std::uint16_t number = datagram.destination.port;
  const std::vector<const vehicle::Sensor*> sensors = sensors_on(number);
  if (sensors.empty()) {
    return;
  }
  Port& port = ports_[number];
  if (port.looked_at++ >= kLookedAt) {
    return;
  }
  std::set<lidar::Format> its_formats;  // each once, however many vehicles have it
  for (const vehicle::Sensor* sensor : sensors) {
    const intake::Packet packet =
        intake::Packet::decode(sensor->format, datagram.payload, sensor->unit());
    if (!packet.is_sound() || !its_formats.insert(sensor->format).second) {
      continue;
    }
    port.formats.insert(sensor->format);
    if (!sends_lux_scans(sensor->format)) {
      continue;
    }
    std::set<std::int32_t> directions;
    packet.for_each_point(
        [&](const lidar::ScanPoint& point) { directions.insert(point.azimuth_ticks); });
    for (auto next = directions.begin(); next != directions.end(); ++next) {
      if (next != directions.begin()) {
        ++port.steps[*next - *std::prev(next)];
      }
    }
  }
}

std::string VehicleLikeness::misfit_of(const vehicle::SensorConfig& sensor) const {
  const auto found = ports_.find(sensor.udp_port);
  const std::string port = "UDP port " + std::to_string(sensor.udp_port);
  if (found == ports_.end() || found->second.formats.empty()) {
    return "no scan comes to " + port;
  }
  if (!found->second.formats.contains(sensor.format)) {
    return "scans of another format come to " + port;
  }
  const auto& steps = found->second.steps;
  const auto usual = std::ranges::max_element(
      steps, {}, [](const auto& step_and_count) { return step_and_count.second; });
  if (!sends_lux_scans(sensor.format) || usual == steps.end() || usual->first == step_of(sensor)) {
    return {};
  }
  return "directions on " + port + " are " + degrees(usual->first) + " degrees apart, not " +
         degrees(step_of(sensor));
}

std::vector<std::string> VehicleLikeness::misfits(const CatalogueEntry& car) const {
  std::vector<std::string> reasons;
  for (const vehicle::SensorConfig& sensor : car.sensors) {
    if (std::string reason = misfit_of(sensor); !reason.empty()) {
      reasons.push_back(std::move(reason));
    }
  }
  for (const auto& [number, port] : ports_) {
    if (!port.formats.empty() && sensor_of_port(car, number) == car.sensors.size()) {
      reasons.push_back("scans come to UDP port " + std::to_string(number));
    }
  }
  return reasons;
}

bool VehicleLikeness::has_scans() const {
  return std::ranges::any_of(
      ports_, [](const auto& number_and_port) { return !number_and_port.second.formats.empty(); });
}

const CatalogueEntry* VehicleLikeness::better_than(const CatalogueEntry& car) const {
  if (!has_scans()) {
    return nullptr;
  }
  const CatalogueEntry* best = nullptr;
  std::size_t fewest = misfits(car).size();
  for (const CatalogueEntry& entry : all_vehicles()) {
    if (const std::size_t count = misfits(entry).size(); count < fewest) {
      fewest = count;
      best = &entry;
    }
  }
  return best;
}

std::string VehicleLikeness::words(const CatalogueEntry& car) const {
  const CatalogueEntry* const other = better_than(car);
  if (other == nullptr) {
    return {};
  }
  return "the packets look like those of " + std::string(other->vehicle->name) + ": " +
         joined(misfits(car));
}

std::string VehicleLikeness::words_of_best() const {
  if (!has_scans()) {
    return {};
  }
  std::size_t fewest = SIZE_MAX;
  std::string names;
  std::vector<std::string> reasons;
  for (const CatalogueEntry& entry : all_vehicles()) {
    std::vector<std::string> its = misfits(entry);
    if (its.size() > fewest) {
      continue;
    }
    if (its.size() < fewest) {
      names.clear();
    }
    names.append(names.empty() ? "" : ", ").append(entry.vehicle->name);
    fewest = its.size();
    reasons = std::move(its);
  }
  return names + (names.empty() || reasons.empty() ? "" : ", but " + joined(reasons));
}

}  // namespace iog::tools
