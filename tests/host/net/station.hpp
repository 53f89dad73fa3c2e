// A host on a fake port, and the law that its counters obey.
#pragma once

#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "fakes/fake_ethernet_port.hpp"
#include "net/frames.hpp"
#include "net/host.hpp"

namespace iog::net::testing {

struct Station {
  explicit Station(const Config& config = kConfig) : host{port, config} {}

  std::optional<Datagram> poll(std::uint64_t now_us = 0) { return host.poll(now_us); }

  // Polls once with this frame alone.
  std::optional<Datagram> take(Frame frame, std::uint64_t now_us = 0) {
    port.arrive(std::move(frame));
    return host.poll(now_us);
  }

  // The first poll, which asks for the peer, and the peer's answer.
  void resolve() {
    static_cast<void>(take(linux_arp_reply()));
    static_cast<void>(port.take_sent());
  }

  [[nodiscard]] std::uint32_t dropped(Drop cause) const { return host.counters().of(cause); }
  [[nodiscard]] std::uint32_t refused(Refusal cause) const { return host.counters().of(cause); }

  [[nodiscard]] std::uint32_t all_dropped() const {
    const auto& drops = host.counters().drops;
    return std::accumulate(drops.begin(), drops.end(), std::uint32_t{0});
  }

  // Every frame that came in went exactly one way, and the port was used as it wants to be.
  [[nodiscard]] bool conserved() const {
    const Counters& c = host.counters();
    return c.received == c.delivered + c.arp_answered + c.arp_learned + c.ping_answered +
                             all_dropped() + c.fragments.joined &&
           c.received == port.counters().received && port.violations() == 0;
  }

  fakes::FakeEthernetPort port;
  Host<fakes::FakeEthernetPort> host;
};

}  // namespace iog::net::testing
