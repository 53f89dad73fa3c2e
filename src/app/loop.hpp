// The loop: everything the firmware does after start-up, on one page.
//
//     wire bytes -> datagram -> scan points -> beams -> cells -> indexes -> tiles -> wire bytes
//
// It never waits: datagrams are taken as they have come, messages go into the transmit ring, and
// only when nothing is left to do does the processor sleep until the next frame or tick.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "app/pipeline.hpp"
#include "app/serial_sink.hpp"
#include "hal/clock.hpp"
#include "hal/ethernet_port.hpp"
#include "hal/serial_port.hpp"
#include "hal/watchdog.hpp"
#include "net/host.hpp"

namespace iog::app {

// A machine: one object of each seam, and how deep its stack has been.
template <typename T>
concept Machine = requires(T& machine) {
  requires hal::Clock<std::remove_reference_t<decltype(machine.clock())>>;
  requires hal::Stopwatch<std::remove_reference_t<decltype(machine.stopwatch())>>;
  requires hal::Watchdog<std::remove_reference_t<decltype(machine.watchdog())>>;
  requires hal::EthernetPort<std::remove_reference_t<decltype(machine.ethernet())>>;
  requires hal::SerialPort<std::remove_reference_t<decltype(machine.serial())>>;
  { machine.stack_used_bytes() } -> std::convertible_to<std::uint32_t>;
  { machine.idle() } -> std::same_as<void>;
};

// At most this many datagrams in one pass, so that a flood cannot keep the loop from its tick and
// its watchdog: a frame of four LUX is 24, a full receive ring 256.
inline constexpr int kMaxDatagramsPerPass = 64;

// The machine as the pipeline's platform.
template <Machine M>
class MachinePlatform {
 public:
  using Port = std::remove_reference_t<decltype(std::declval<M&>().ethernet())>;

  MachinePlatform(M& machine, const net::Config& config)
      : machine_(machine), host_(machine.ethernet(), config) {}

  [[nodiscard]] net::Host<Port>& host() { return host_; }

  // The line's transmitter is looked after between two messages, too: there may be hundreds.
  [[nodiscard]] bool send_message(std::span<const std::byte> message) {
    machine_.serial().pump();
    return host_.send_message(message);
  }

  std::uint32_t ticks() { return machine_.stopwatch().ticks(); }
  std::uint32_t ticks_hz() { return machine_.stopwatch().ticks_hz(); }

  // The link's counters in the order of docs/spec.md; damaged datagrams count as dropped packets.
  [[nodiscard]] Vitals vitals() {
    Vitals vitals{.stack_used_bytes = machine_.stack_used_bytes()};
    const net::Counters& net = host_.counters();
    const hal::PortCounters port = machine_.ethernet().counters();
    std::span<std::uint32_t> out = vitals.link_counters;
    const auto append = [&](std::span<const std::uint32_t> values) {
      std::ranges::copy(values, out.begin());
      out = out.subspan(values.size());
    };
    append(std::array{net.received, net.delivered, net.arp_answered, net.arp_learned,
                      net.ping_answered, net.sent, net.arp_requested});
    append(net.drops);
    append(net.refusals);
    append(std::array{port.received, port.receive_errors, port.oversized, port.sent,
                      port.send_refused});
    vitals.link_counter_count = vitals.link_counters.size() - out.size();
    vitals.link_drops = port.receive_errors + port.oversized;
    for (const net::Drop cause : kDamaged) {
      vitals.link_drops += net.drops[static_cast<std::size_t>(cause)];
    }
    return vitals;
  }

 private:
  // Frames that claimed to be for us and were not sound. Other people's traffic is no loss.
  static constexpr std::array kDamaged{
      net::Drop::kShort,          net::Drop::kBadIpHeader, net::Drop::kBadIpChecksum,
      net::Drop::kFragment,       net::Drop::kBadSource,   net::Drop::kBadUdpLength,
      net::Drop::kBadUdpChecksum,
  };

  M& machine_;
  net::Host<Port> host_;
};

// The target's pipeline: every frame goes to the network, and to the serial link what it can carry.
template <Machine M>
using MachinePipeline = Pipeline<MachinePlatform<M>, SerialSink>;

// One pass: what has come, what is due, what can go. Returns whether frames are still waiting.
template <Machine M>
bool pass(M& machine, MachinePlatform<M>& platform, SerialSink& serial,
          MachinePipeline<M>& pipeline) {
  const std::uint64_t now_us = machine.clock().now_us();
  for (int taken = 0; taken < kMaxDatagramsPerPass; ++taken) {
    const auto datagram = platform.host().poll(now_us);
    if (!datagram) {
      break;
    }
    pipeline.take({datagram->source.value, datagram->destination_port, datagram->payload}, now_us);
    machine.serial().pump();
  }
  pipeline.tick(now_us);
  machine.ethernet().pump();
  serial.pump(now_us, machine.serial());
  machine.watchdog().service();
  return !machine.ethernet().receive().empty();
}

// Never returns. The pipeline holds the grid and belongs into static memory.
template <Machine M>
[[noreturn]] void run(M& machine, MachinePlatform<M>& platform, SerialSink& serial,
                      MachinePipeline<M>& pipeline) {
  for (;;) {
    if (!pass(machine, platform, serial, pipeline)) {
      machine.idle();
    }
  }
}

}  // namespace iog::app
