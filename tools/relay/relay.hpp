// From the TCP connections of a car's ibeo units to the UDP ports of its target (docs/spec.md,
// section 1.2.3): every scan in messages that fit a datagram.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/relay/unit_link.hpp"

namespace iog::tools {

struct RelayedUnit {
  std::string name;  // for people
  std::string host;  // a dotted IPv4 address
  std::uint16_t tcp_port = kLuxTcpPort;
};

class Relay {
 public:
  // One datagram of that unit; false if the system did not take it.
  using Send = std::function<bool(std::size_t unit, std::span<const std::byte> datagram)>;
  // A line for people, of what has become of a connection.
  using Tell = std::function<void(const std::string& line)>;

  struct Counts {
    std::uint64_t sent = 0;
    std::uint64_t refused = 0;  // by the system
  };

  // UsageError if a host is no address.
  Relay(std::vector<RelayedUnit> units, Send send, Tell tell, UnitLink::Patience patience = {});

  // Waits for so long at most, and relays what has come by then.
  void wait(std::chrono::milliseconds most);

  [[nodiscard]] std::size_t size() const { return units_.size(); }
  [[nodiscard]] const UnitLink& link(std::size_t unit) const { return links_[unit]; }
  [[nodiscard]] const Counts& counts(std::size_t unit) const { return counts_[unit]; }

  // "roof: 250 scans ..."
  [[nodiscard]] std::string words_of(std::size_t unit) const;

 private:
  void relay(std::size_t unit, LuxScan scan);
  void tell_changes();

  std::vector<RelayedUnit> units_;
  Send send_;
  Tell tell_;
  std::deque<UnitLink> links_;  // by unit, as all below
  std::vector<Counts> counts_;
  std::vector<bool> was_connected_;
  std::vector<std::string> told_faults_;
};

}  // namespace iog::tools
