// Why a capture does not fit a car (CaptureIdentity::refusal()).
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "pose/message.hpp"
#include "tools/identity/capture_identity.hpp"
#include "tools/identity/unit_words.hpp"
#include "tools/program/joined.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

std::string CaptureIdentity::advice(const CatalogueEntry& car) const {
  const std::vector<const CatalogueEntry*> others = better_ones(car);
  if (!others.empty()) {
    return ": try --vehicle " +
           joined(others, " or ", [](const CatalogueEntry* other) { return other->vehicle->name; });
  }
  return has_ours()
             ? ": no car that iog knows has it there; docs/vehicles.md says how to describe one"
             : "";
}

std::string CaptureIdentity::words_without_packet_for(const CatalogueEntry& car) const {
  std::vector<std::string> units;
  std::vector<std::string> own;
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    if (std::string unit = sensor_words(car, i); std::ranges::find(units, unit) == units.end()) {
      units.push_back(std::move(unit));
    }
    own.push_back(std::to_string(car.sensors[i].udp_port));
  }
  std::string text = "no packet is for a sensor of " + std::string(car.vehicle->name) + " (" +
                     joined(units, "; ") + "; UDP port " + joined(own, ", ") + "); ";
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
  if (first_of(Kind::kRefused) != all.end()) {
    return words_of_ports();
  }
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
