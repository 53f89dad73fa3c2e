#include "tools/identity/capture_identity.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "intake/packet.hpp"
#include "lidar/formats.hpp"
#include "lidar/scanner_facts.hpp"
#include "pose/message.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/program/joined.hpp"
#include "tools/vehicles/network_words.hpp"

namespace iog::tools {
namespace {

// Of a sender to a port; they are all alike.
constexpr std::uint64_t kLookedAt = 400;
// So many of each port of a car, or so many of all, are enough to know them.
constexpr std::uint64_t kEnoughOfPort = 50;
constexpr std::uint64_t kEnoughOfAll = 20'000;
constexpr std::size_t kNamedPorts = 8;  // more would hide what matters

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
std::int32_t step_of(const description::SensorConfig& sensor) {
  const auto directions =
      static_cast<std::int32_t>(sensor.max_points_per_scan / lidar::IbeoLux::kElevationsDeg.size() /
                                lidar::IbeoLux::kMaxEchoes);
  return directions > 1 ? sensor.scan_width_ticks / (directions - 1) : 0;
}

std::string degrees(std::int32_t ticks) {
  std::string text = std::to_string(360.0 * ticks / lidar::IbeoLux::kTicksPerTurn);
  return text.substr(0, text.find('.') + 3);
}

// "an Ouster OS"
std::string one(std::string_view name) {
  const bool is_spoken_open =
      std::string_view("AEIOUaeiou").find(name.front()) != std::string::npos;
  return (is_spoken_open ? "an " : "a ") + std::string(name);
}

bool is_name_of_ours(std::string_view name) {
  bool is_one = false;
  for (unsigned number = 0; number < lidar::kFormatCount; ++number) {
    is_one = is_one || lidar::name_of(static_cast<lidar::Format>(number)) == name;
  }
  return is_one;
}

bool has_points_only(const CatalogueEntry& car) {
  return std::ranges::all_of(car.sensors, [](const description::SensorConfig& sensor) {
    return lidar::facts_of(sensor.format).is_points;
  });
}

std::string port_words(std::uint16_t number) { return "UDP port " + std::to_string(number); }

}  // namespace

std::string CaptureIdentity::Port::name() const {
  return names.empty() ? doubted : joined(names, ", ");
}

void CaptureIdentity::add(const CapturedDatagram& datagram) {
  ++datagrams_;
  Port& port = ports_[datagram.destination.port];
  ++port.datagrams;
  for (auto& [sensor, senders] : port.its_senders) {
    if (const auto its = senders.find(datagram.source.ipv4); its != senders.end()) {
      its->second.last_us = datagram.time_us;
    }
  }
  if (port.senders.size() >= kMostSenders && !port.senders.contains(datagram.source.ipv4)) {
    ++port.of_others;
    return;
  }
  Sender& sender = port.senders[datagram.source.ipv4];
  if (sender.datagrams++ >= kLookedAt) {
    return;
  }
  const SeenUnit seen = sender.watch.take(datagram.payload);
  if (seen.name.empty()) {
    return;
  }
  port.has_ours = port.has_ours || !seen.formats.is_empty();
  port.has_other_mode =
      port.has_other_mode || (seen.formats.is_empty() && is_name_of_ours(seen.name));
  if (seen.is_in_doubt) {
    port.doubted = seen.name;
    port.doubted_formats = seen.formats;
    return;
  }
  port.names.insert(seen.name);
  for (const vehicle::Sensor* sensor : sensors_on(datagram.destination.port)) {
    if (seen.formats.has(sensor->format) &&
        intake::Packet::decode(sensor->format, datagram.payload, sensor->unit()).is_sound()) {
      const Heard now{.first_us = datagram.time_us, .last_us = datagram.time_us};
      port.its_senders[sensor].try_emplace(datagram.source.ipv4, now);
    }
  }
  if (seen.formats.has(lidar::kFormat<lidar::IbeoLux>)) {
    note_directions(datagram.payload, port);
  }
}

void CaptureIdentity::note_directions(std::span<const std::byte> scan, Port& port) {
  std::set<std::int32_t> directions;
  lidar::IbeoLux lux;
  if (lux.decode(scan) == lidar::DecodeStatus::kOk) {
    lux.for_each_point(
        [&](const lidar::ScanPoint& point) { directions.insert(point.azimuth_ticks); });
  }
  for (auto next = directions.begin(); next != directions.end(); ++next) {
    if (next != directions.begin()) {
      ++port.steps[*next - *std::prev(next)];
    }
  }
}

bool CaptureIdentity::is_settled(const CatalogueEntry& car) const {
  return datagrams_ >= kEnoughOfAll ||
         std::ranges::all_of(car.sensors, [&](const description::SensorConfig& sensor) {
           const auto port = ports_.find(sensor.udp_port);
           return port != ports_.end() && port->second.datagrams >= kEnoughOfPort;
         });
}

CaptureIdentity::Misfit CaptureIdentity::misfit_of(const CatalogueEntry& car,
                                                   std::size_t number) const {
  using Kind = Misfit::Kind;
  const description::SensorConfig& sensor = car.sensors[number];
  const auto found = ports_.find(sensor.udp_port);
  const std::string its_port = port_words(sensor.udp_port);
  if (found == ports_.end() || !found->second.is_of_lidar()) {
    return {Kind::kSilent, "no scan comes to " + its_port};
  }
  const Port& port = found->second;
  if (!port.its_senders.contains(&car.vehicle->sensors[number])) {
    const bool is_in_doubt = port.names.empty() && port.doubted_formats.has(sensor.format);
    std::string words = "what comes to " + its_port + " is of " + one(port.name()) +
                        ", and sensor " + std::string(sensor.name) + " of " +
                        std::string(car.vehicle->name) + " is " +
                        one(lidar::name_of(sensor.format));
    if (sensor.mode != lidar::TurnMode{}) {
      words += " " + std::to_string(car.vehicle->sensors[number].layer_count) + ", " +
               std::to_string(sensor.mode.columns_per_turn) + "x" +
               std::to_string(sensor.mode.turns_per_second);
    }
    return {
        is_in_doubt ? Kind::kInDoubt : Kind::kOther,
        words + (is_in_doubt ? ": too few packets to tell which, and in doubt none is fused" : "")};
  }
  const auto usual = std::ranges::max_element(
      port.steps, {}, [](const auto& step_and_count) { return step_and_count.second; });
  if (usual == port.steps.end() || usual->first == step_of(sensor)) {
    return {};
  }
  return {usual->first < step_of(sensor) ? Kind::kFiner : Kind::kCoarser,
          "directions on " + its_port + " are " + degrees(usual->first) + " degrees apart, not " +
              degrees(step_of(sensor))};
}

std::vector<CaptureIdentity::Misfit> CaptureIdentity::all_misfits(const CatalogueEntry& car) const {
  std::vector<Misfit> all;
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    if (Misfit misfit = misfit_of(car, i); misfit.kind != Misfit::Kind::kNone) {
      all.push_back(std::move(misfit));
    }
  }
  for (const auto& [number, port] : ports_) {
    if (port.has_ours && sensor_of_port(car, number) == car.sensors.size()) {
      all.push_back({Misfit::Kind::kSilent, "scans come to " + port_words(number)});
    }
  }
  return all;
}

std::vector<std::string> CaptureIdentity::misfits(const CatalogueEntry& car) const {
  std::vector<std::string> reasons;
  for (Misfit& misfit : all_misfits(car)) {
    reasons.push_back(std::move(misfit.words));
  }
  return reasons;
}

bool CaptureIdentity::has_sender(const CatalogueEntry& car) const {
  return std::ranges::any_of(car.vehicle->sensors, [&](const vehicle::Sensor& sensor) {
    const auto port = ports_.find(sensor.udp_port);
    return port != ports_.end() && port->second.its_senders.contains(&sensor);
  });
}

bool CaptureIdentity::has_ours() const {
  return std::ranges::any_of(
      ports_, [](const auto& number_and_port) { return number_and_port.second.has_ours; });
}

const CatalogueEntry* CaptureIdentity::better_than(const CatalogueEntry& car) const {
  const CatalogueEntry* best = nullptr;
  std::size_t fewest = misfits(car).size();
  for (const CatalogueEntry& entry : all_vehicles()) {
    if (const std::size_t count = misfits(entry).size(); count < fewest && has_sender(entry)) {
      fewest = count;
      best = &entry;
    }
  }
  return best;
}

std::string CaptureIdentity::words(const CatalogueEntry& car) const {
  const CatalogueEntry* const other = better_than(car);
  if (other == nullptr) {
    return {};
  }
  return "the packets look like those of " + std::string(other->vehicle->name) + ": " +
         joined(misfits(car), "; ");
}

std::string CaptureIdentity::words_of_wrong_port(const CatalogueEntry& car) const {
  std::vector<std::string> silent;
  std::vector<std::string> other;
  for (const description::SensorConfig& sensor : car.sensors) {
    if (!ports_.contains(sensor.udp_port)) {
      silent.push_back(std::to_string(sensor.udp_port));
    }
  }
  for (const auto& [number, port] : ports_) {
    if (port.has_ours && sensor_of_port(car, number) == car.sensors.size()) {
      other.push_back(std::to_string(number));
    }
  }
  other.resize(std::min(other.size(), kNamedPorts));
  return silent.empty() || other.empty()
             ? ""
             : "nothing comes to UDP port " + joined(silent, ", ") + ", and scans come to port " +
                   joined(other, ", ") + ": is udp_port in the car file right?";
}

std::string CaptureIdentity::words_of_crowd(const CatalogueEntry& car) const {
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    const description::SensorConfig& sensor = car.sensors[i];
    const auto port = ports_.find(sensor.udp_port);
    if (port == ports_.end() || !port->second.its_senders.contains(&car.vehicle->sensors[i])) {
      continue;
    }
    const auto& sources = port->second.its_senders.at(&car.vehicle->sensors[i]);
    std::string words = tools::words_of_crowd(sensor, sources, port->second.of_others > 0);
    if (!words.empty()) {
      return words;
    }
  }
  return {};
}

std::string CaptureIdentity::words_of_best() const {
  std::size_t fewest = SIZE_MAX;
  std::vector<std::string> names;
  std::vector<std::string> reasons;
  bool has_points = false;
  for (const CatalogueEntry& entry : all_vehicles()) {
    // Points come from any lidar, so they do not tell one car of vehicles/ from a user's own.
    if (!is_of_file(entry) && has_points_only(entry)) {
      has_points = has_points || has_sender(entry);
      continue;
    }
    std::vector<std::string> its = misfits(entry);
    if (its.size() > fewest || !has_sender(entry)) {
      continue;
    }
    if (its.size() < fewest) {
      names.clear();
    }
    names.emplace_back(entry.vehicle->name);
    fewest = its.size();
    if (std::string crowd = words_of_crowd(entry); !crowd.empty()) {
      its.push_back(std::move(crowd));
    }
    reasons = std::move(its);
  }
  if (names.empty() && has_points) {
    return "a car of your own with a sensor of type points or points_turning";
  }
  if (names.empty()) {
    const std::string ports = words_of_ports();
    return ports.empty() ? ports : "no car that iog knows: " + ports;
  }
  return joined(names, ", ") + (reasons.empty() ? "" : ", but " + joined(reasons, "; "));
}

// What comes to the ports, of those that a lidar's packets come to.
std::string CaptureIdentity::words_of_ports() const {
  std::vector<std::string> parts;
  for (const auto& [number, port] : ports_) {
    if (port.is_of_lidar() && parts.size() < kNamedPorts) {
      parts.push_back("what comes to " + port_words(number) + " is of " + one(port.name()) +
                      (port.has_other_mode ? " in a mode that iogrid does not take" : ""));
    }
  }
  if (parts.empty() || has_ours()) {
    return joined(parts, "; ");
  }
  const bool has_other_mode = std::ranges::any_of(
      ports_, [](const auto& number_and_port) { return number_and_port.second.has_other_mode; });
  return joined(parts, "; ") +
         (has_other_mode
              ? " (docs/sensors.md, \"Two returns\")"
              : ", and iogrid takes none of such a unit (docs/sensors.md lists those it takes)");
}

std::string CaptureIdentity::advice(const CatalogueEntry& car) const {
  const CatalogueEntry* const other = better_than(car);
  if (other != nullptr) {
    return ": try --vehicle " + std::string(other->vehicle->name);
  }
  return has_ours()
             ? ": no car that iog knows has it there; docs/vehicles.md says how to describe one"
             : "";
}

std::string CaptureIdentity::words_without_packet_for(const CatalogueEntry& car) const {
  std::vector<std::string> own;
  for (const description::SensorConfig& sensor : car.sensors) {
    own.push_back(std::to_string(sensor.udp_port));
  }
  std::string text = "no packet is for a sensor of " + std::string(car.vehicle->name) +
                     " (UDP port " + joined(own, ", ") + "); ";
  if (ports_.empty()) {
    return text + "it holds no whole UDP packet";
  }
  if (const std::string of_ports = words_of_ports(); !of_ports.empty()) {
    return text + of_ports + advice(car);
  }
  std::vector<std::string> others;
  std::size_t count = 0;
  for (const auto& [number, port] : ports_) {
    if (is_pose_port(car, number) || number == pose::kPosePort) {
      continue;
    }
    if (++count <= kNamedPorts) {
      others.push_back(std::to_string(number));
    }
  }
  if (count == 0) {
    return text + "all its whole packets are poses";
  }
  return text + "its packets go to port " + joined(others, ", ") +
         (others.size() < count ? " and others" : "") + ", of no lidar that iog knows";
}

std::string CaptureIdentity::refusal(const CatalogueEntry& car) const {
  using Kind = Misfit::Kind;
  const bool is_for_it = std::ranges::any_of(ports_, [&](const auto& number_and_port) {
    return sensor_of_port(car, number_and_port.first) < car.sensors.size();
  });
  if (!is_for_it) {
    return words_without_packet_for(car);
  }
  const std::vector<Misfit> all = all_misfits(car);
  const auto first_of = [&](Kind kind) { return std::ranges::find(all, kind, &Misfit::kind); };
  if (const auto other = first_of(Kind::kOther); other != all.end()) {
    return (has_ours() ? other->words : words_of_ports()) + advice(car);
  }
  if (const auto doubt = first_of(Kind::kInDoubt); doubt != all.end() && !has_sender(car)) {
    return doubt->words;
  }
  if (std::string crowd = words_of_crowd(car); !crowd.empty()) {
    return crowd;
  }
  // How many points a LUX of a user's own car may send says little of how many directions it has.
  const bool is_finer = first_of(Kind::kFiner) != all.end() && !is_of_file(car);
  const CatalogueEntry* const better = is_finer ? better_than(car) : nullptr;
  return better == nullptr ? "" : words(car) + advice(car);
}

}  // namespace iog::tools
