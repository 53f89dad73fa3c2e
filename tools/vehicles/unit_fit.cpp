#include "tools/vehicles/unit_fit.hpp"

#include <algorithm>

#include "lidar/formats.hpp"
#include "tools/formats/lidar/format_names.hpp"

namespace iog::tools {
namespace {

// A vehicle with a scanner of that format on that port; nullptr: none.
const CatalogueEntry* vehicle_with(lidar::FormatSet formats, std::uint16_t udp_port) {
  for (const CatalogueEntry& entry : all_vehicles()) {
    const std::size_t sensor = sensor_of_port(entry, udp_port);
    if (sensor < entry.sensors.size() &&
        formats == lidar::FormatSet(entry.sensors[sensor].format)) {
      return &entry;
    }
  }
  return nullptr;
}

}  // namespace

UnitFit::Verdict UnitFit::take(const CapturedDatagram& packet) {
  sensor_ = sensor_of_port(*car_, packet.destination.port);
  possible_ = identities_[packet.destination.port].take(packet.payload);
  const lidar::FormatSet described(car_->sensors[sensor_].format);
  if (possible_.is_empty() || possible_ == described) {
    return Verdict::kFits;
  }
  return possible_.has(car_->sensors[sensor_].format) ? Verdict::kInDoubt : Verdict::kOther;
}

std::string UnitFit::words() const {
  const vehicle::SensorConfig& sensor = car_->sensors[sensor_];
  const bool is_in_doubt = possible_.has(sensor.format);
  std::string text = "what comes to UDP port " + std::to_string(sensor.udp_port) + " is of a " +
                     names_of(possible_) + ", and sensor " + std::string(sensor.name) + " of " +
                     std::string(car_->vehicle->name) + " is a " +
                     std::string(lidar::name_of(sensor.format));
  if (is_in_doubt) {
    return text + ": too few packets to tell which, and in doubt none is fused";
  }
  const CatalogueEntry* const other = vehicle_with(possible_, sensor.udp_port);
  return other == nullptr ? text : text + ": try --vehicle " + std::string(other->vehicle->name);
}

}  // namespace iog::tools
