#include "tools/relay/relay.hpp"

#include <algorithm>
#include <poll.h>
#include <sstream>
#include <utility>

#include "tools/formats/lux/lux_scan.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

std::string place_of(const RelayedUnit& unit) {
  return unit.name + " at " + unit.host + ':' + std::to_string(unit.tcp_port);
}

}  // namespace

Relay::Relay(std::vector<RelayedUnit> units, Send send, Tell tell, UnitLink::Patience patience)
    : units_(std::move(units)),
      send_(std::move(send)),
      tell_(std::move(tell)),
      counts_(units_.size()),
      was_connected_(units_.size()),
      told_faults_(units_.size()) {
  for (const RelayedUnit& unit : units_) {
    links_.emplace_back(unit.host, unit.tcp_port, patience);
  }
}

void Relay::relay(std::size_t unit, LuxScan scan) {
  const std::vector<std::vector<std::byte>> messages = split_lux_scan(std::move(scan));
  for (const std::vector<std::byte>& message : messages) {
    ++(send_(unit, message) ? counts_[unit].sent : counts_[unit].refused);
  }
}

// A unit that is switched off is told of once, not with each try.
void Relay::tell_changes() {
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const bool is_connected = links_[i].is_connected();
    const std::string& fault = links_[i].last_fault();
    if (is_connected && !was_connected_[i]) {
      tell_(place_of(units_[i]) + ": connected");
      told_faults_[i].clear();
    } else if (!is_connected && fault != told_faults_[i]) {
      tell_(place_of(units_[i]) + ": " + fault + "; trying again");
      told_faults_[i] = fault;
    }
    was_connected_[i] = is_connected;
  }
}

void Relay::wait(std::chrono::milliseconds most) {
  const auto before = UnitLink::Clock::now();
  std::vector<pollfd> awaited;
  for (UnitLink& its : links_) {
    its.move_on(before);
    awaited.push_back({its.socket(), its.awaited(), 0});
  }
  // poll() passes over sockets that are negative.
  const int ready = poll(awaited.data(), awaited.size(), static_cast<int>(most.count()));
  const auto now = UnitLink::Clock::now();
  for (std::size_t i = 0; ready > 0 && i < links_.size(); ++i) {
    if (awaited[i].revents != 0) {
      links_[i].take(now, [this, i](LuxScan scan) { relay(i, std::move(scan)); });
    }
  }
  tell_changes();
}

std::string Relay::words_of(std::size_t unit) const {
  const UnitLink& its = links_[unit];
  const ScanStream::Counts& stream = its.scan_counts();
  std::ostringstream out;
  out << units_[unit].name << ": " << counted(stream.scans, "scan|scans, ")
      << counted(counts_[unit].sent, "datagram|datagrams sent, ") << counts_[unit].refused
      << " refused by the system; " << counted(stream.other_messages, "other message|messages, ")
      << stream.malformed << " malformed, " << stream.skipped_bytes << " bytes skipped; "
      << counted(its.counts().connections, "connection|connections, ") << its.counts().losses
      << " lost";
  return out.str();
}

}  // namespace iog::tools
