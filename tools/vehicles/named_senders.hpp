// Of captures, where several units may send to a sensor's port.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tools/program/joined.hpp"
#include "tools/program/table.hpp"
#include "tools/vehicles/network_words.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// When the first and the last packet of a sender came.
struct Heard {
  std::uint64_t first_us = 0;
  std::uint64_t last_us = 0;
};

// The addresses of those that send at the same time as another one. A unit whose address changes
// does not, and a single packet says nothing.
[[nodiscard]] inline std::vector<std::string> senders_at_once(
    const std::map<std::uint32_t, Heard>& senders) {
  std::vector<std::string> addresses;
  for (const auto& one : senders) {
    const auto is_beside = [&one](const auto& other) {
      return other.first != one.first && other.second.first_us < other.second.last_us &&
             other.second.first_us < one.second.last_us &&
             one.second.first_us < other.second.last_us;
    };
    if (one.second.first_us < one.second.last_us && std::ranges::any_of(senders, is_beside)) {
      addresses.push_back(dotted(one.first));
    }
  }
  return addresses;
}

// Of a map by sender, with room for so many: each has a watch or a span of times.
inline constexpr std::size_t kMostSenders = 64;
inline constexpr std::size_t kNamedSenders = 8;  // in words; more would hide what matters

// Packets of further senders are not noted.
inline void note(std::uint32_t source_ipv4, std::uint64_t time_us,
                 std::map<std::uint32_t, Heard>& senders) {
  if (const auto known = senders.find(source_ipv4); known != senders.end()) {
    known->second.last_us = time_us;
  } else if (senders.size() < kMostSenders) {
    senders.emplace(source_ipv4, Heard{.first_us = time_us, .last_us = time_us});
  }
}

// "2 units send to UDP port 2368 (10.0.2.100, 10.0.2.101)…": the senders of what a sensor sends,
// and whether there were further ones. Empty if not several send at once, or if the car's file
// names one of them.
[[nodiscard]] inline std::string words_of_crowd(const description::SensorConfig& sensor,
                                                const std::map<std::uint32_t, Heard>& senders,
                                                bool has_others) {
  std::vector<std::string> addresses = senders_at_once(senders);
  if (addresses.empty() || senders.contains(sensor.source_ipv4)) {
    return {};
  }
  const std::size_t count = addresses.size();
  addresses.resize(std::min(count, kNamedSenders));
  return std::to_string(count) + " units send to UDP port " + std::to_string(sensor.udp_port) +
         " (" + joined(addresses, ", ") + (has_others ? ", and packets of further senders" : "") +
         "): set source_ipv4 of sensor " + std::string(sensor.name) + " in the car file";
}

// Knows the strangers on the ports of a car whose file names the senders (`source_ipv4`). What was
// recorded elsewhere has other addresses, so nobody is a stranger until the named sender was heard.
class NamedSenders {
 public:
  explicit NamedSenders(const CatalogueEntry& car) : car_(&car) {}

  [[nodiscard]] bool is_stranger(std::uint32_t source_ipv4, std::uint16_t udp_port) {
    const std::size_t sensor = sensor_of_port(*car_, udp_port);
    if (sensor == car_->sensors.size() || car_->sensors[sensor].source_ipv4 == 0) {
      return false;
    }
    const bool is_named = car_->sensors[sensor].source_ipv4 == source_ipv4;
    if (is_named) {
      heard_.insert(sensor);
    }
    const bool is_stranger = !is_named && heard_.contains(sensor);
    strangers_ += is_stranger ? 1U : 0U;
    if (!is_named && !is_stranger) {
      Others& others = used_[sensor];
      ++others.packets;
      if (others.addresses.size() < kMostSenders) {
        others.addresses.insert(source_ipv4);
      }
    }
    return is_stranger;
  }

  // How many packets of theirs have come, also before the named sender was heard, and which named
  // senders were not heard; empty if there is nothing to tell.
  [[nodiscard]] std::string words() const {
    std::size_t before = 0;
    std::string unheard;
    for (const auto& [sensor, others] : used_) {
      before += heard_.contains(sensor) ? others.packets : 0;
      unheard += heard_.contains(sensor)
                     ? ""
                     : (unheard.empty() ? "" : "; ") + words_of_unheard(sensor, others);
    }
    constexpr std::string_view kLeftOut =
        "packet|packets of another sender than `source_ipv4` is|are not used";
    constexpr std::string_view kUsed =
        "packet|packets of another sender came before its first one and was|were used";
    std::string text = strangers_ == 0 ? std::string{} : counted(strangers_, kLeftOut);
    if (before > 0) {
      text.append(text.empty() ? "" : "; ").append(counted(before, kUsed));
    }
    return text + (text.empty() || unheard.empty() ? "" : "; ") + unheard;
  }

 private:
  // Senders that are not the named one.
  struct Others {
    std::size_t packets = 0;
    std::set<std::uint32_t> addresses;
  };

  [[nodiscard]] std::string words_of_unheard(std::size_t number, const Others& others) const {
    const description::SensorConfig& sensor = car_->sensors[number];
    std::vector<std::string> addresses;
    for (const std::uint32_t address : others.addresses) {
      if (addresses.size() < kNamedSenders) {
        addresses.push_back(dotted(address));
      }
    }
    return "packets to UDP port " + std::to_string(sensor.udp_port) + " come from " +
           joined(addresses, ", ") +
           (others.addresses.size() > kNamedSenders ? " and others" : "") +
           ": iog uses them, but a target drops all but source_ipv4 " + dotted(sensor.source_ipv4) +
           " of sensor " + std::string(sensor.name) + " (check the car file)";
  }

  const CatalogueEntry* car_;
  std::set<std::size_t> heard_;         // sensors of the car
  std::map<std::size_t, Others> used_;  // by sensor
  std::size_t strangers_ = 0;
};

}  // namespace iog::tools
