#include "tools/identity/capture_identity.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

#include "intake/packet.hpp"
#include "lidar/formats.hpp"
#include "lidar/scanner_facts.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/identity/unit_words.hpp"
#include "tools/program/joined.hpp"
#include "tools/vehicles/network_words.hpp"

namespace iog::tools {
namespace {

// Of a sender to a port; they are all alike.
constexpr std::uint64_t kLookedAt = 400;
// So many of each port of a car, or so many of all, are enough to know them.
constexpr std::uint64_t kEnoughOfPort = 50;
constexpr std::uint64_t kEnoughOfAll = 20'000;

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

bool has_points_only(const CatalogueEntry& car) {
  return std::ranges::all_of(car.sensors, [](const description::SensorConfig& sensor) {
    return lidar::facts_of(sensor.format).is_points;
  });
}

std::string port_words(std::uint16_t number) { return "UDP port " + std::to_string(number); }

}  // namespace

std::string CaptureIdentity::Port::words(std::uint16_t number) const {
  return port_words(number) + " receives " +
         (names.empty() ? with_article(doubted)
                        : joined(names, " and ", [](const auto& name_and_fault) {
                            return with_article(name_and_fault.first).append(name_and_fault.second);
                          }));
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
  port.has_ours = port.has_ours || seen.is_sound;
  if (seen.is_in_doubt) {
    port.doubted = seen.name;
    port.doubted_formats = seen.formats;
    return;
  }
  const auto its = port.names.try_emplace(seen.name, fault_of(seen)).first;
  its->second = seen.is_sound ? std::string_view() : its->second;
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
    const std::string words = port.words(sensor.udp_port);
    const auto its = port.names.find(std::string(lidar::name_of(sensor.format)));
    if (its != port.names.end() && !its->second.empty()) {
      return {Kind::kRefused, words};
    }
    const std::string own = sensor_words(car, number);
    const bool is_in_other_mode = std::ranges::any_of(port.names, [&](const auto& name_and_fault) {
      return own.starts_with(name_and_fault.first + ", ");
    });
    const bool is_in_doubt = port.names.empty() && port.doubted_formats.has(sensor.format);
    return {is_in_doubt ? Kind::kInDoubt : Kind::kOther,
            words + (is_in_other_mode ? " in another mode" : "") + ", but sensor " +
                std::string(sensor.name) + " of " + std::string(car.vehicle->name) + " is " +
                with_article(own) +
                (is_in_doubt ? ": too few packets to tell which, so none is fused" : "")};
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

bool CaptureIdentity::has_sender_on_ports_of(const CatalogueEntry& other,
                                             const CatalogueEntry& car) const {
  return std::ranges::any_of(other.vehicle->sensors, [&](const vehicle::Sensor& sensor) {
    const auto port = ports_.find(sensor.udp_port);
    return sensor_of_port(car, sensor.udp_port) < car.sensors.size() && port != ports_.end() &&
           port->second.its_senders.contains(&sensor);
  });
}

std::vector<const CatalogueEntry*> CaptureIdentity::better_ones(const CatalogueEntry& car) const {
  std::vector<const CatalogueEntry*> best;
  std::size_t fewest = misfits(car).size();
  for (const CatalogueEntry& entry : all_vehicles()) {
    const std::size_t count = misfits(entry).size();
    if (count > fewest || (count == fewest && best.empty()) || !has_sender(entry)) {
      continue;
    }
    if (count < fewest) {
      best.clear();
    }
    fewest = count;
    best.push_back(&entry);
  }
  const auto is_on_ports = [&](const auto* other) { return has_sender_on_ports_of(*other, car); };
  if (std::ranges::any_of(best, is_on_ports)) {
    std::erase_if(best, std::not_fn(is_on_ports));
  }
  return best;
}

const CatalogueEntry* CaptureIdentity::better_than(const CatalogueEntry& car) const {
  const std::vector<const CatalogueEntry*> best = better_ones(car);
  return best.empty() ? nullptr : best.front();
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
             : "no packet comes to UDP port " + joined(silent, ", ") + ", but scans come to " +
                   joined(other, ", ") + ": check udp_port in the car file";
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
      parts.push_back(port.words(number));
    }
  }
  if (parts.empty() || has_ours()) {
    return joined(parts, "; ");
  }
  const std::string words = joined(parts, "; ");
  if (words.find(kOfOtherMode) != std::string::npos) {
    return words + " (docs/sensors.md, \"Two returns\")";
  }
  return words + (words.find(kDamaged) != std::string::npos
                      ? ": record it again"
                      : ", which iogrid does not support (docs/sensors.md lists the units it "
                        "supports)");
}

}  // namespace iog::tools
