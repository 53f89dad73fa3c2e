// Plays a capture into a target, in the order and by the clock of `iog fuse`
// (tools/fuse/offline_target.hpp), so that both see the same frames.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "app/frame_engine.hpp"
#include "capture.hpp"
#include "instruction_counter.hpp"
#include "net/ethernet.hpp"
#include "net/ipv4.hpp"
#include "net/udp.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

// A sender that may speak for every sensor, because a capture stands for its replay.
inline constexpr std::uint32_t kReplayer = 0x0A000202;

// From the wire to a datagram, as net::Host does it; addresses are not compared.
inline std::optional<net::Datagram> datagram_in(std::span<const std::byte> bytes) {
  const auto frame = net::parse_ethernet(bytes);
  if (!frame || frame->type != net::kEtherTypeIpv4) {
    return std::nullopt;
  }
  const net::Ipv4Result ip = net::parse_ipv4(frame->payload);
  if (ip.status != net::Ipv4Status::kOk || ip.packet.protocol != net::kProtocolUdp) {
    return std::nullopt;
  }
  const net::UdpResult udp = net::parse_udp(ip.packet);
  return udp.status == net::UdpStatus::kOk ? std::optional(udp.datagram) : std::nullopt;
}

inline const vehicle::Sensor* sensor_of_port(const vehicle::Vehicle& vehicle, std::uint16_t port) {
  const auto found = std::ranges::find(vehicle.sensors, port, &vehicle::Sensor::udp_port);
  return found == vehicle.sensors.end() ? nullptr : &*found;
}

// Target: take(sensor, datagram, instructions spent on receiving it, now), tick(now),
// deadline_us(). After the capture the open frame times out.
template <typename Target>
void play(Capture& capture, const vehicle::Vehicle& vehicle, InstructionCounter& counter,
          Target& target) {
  tools::CaptureClock clock;
  while (const auto frame = capture.next()) {
    const std::uint32_t start = counter.now();
    const auto datagram = datagram_in(frame->bytes);
    const std::uint32_t received = counter.now() - start - counter.of_nothing();
    const vehicle::Sensor* const sensor =
        datagram ? sensor_of_port(vehicle, datagram->destination_port) : nullptr;
    if (sensor == nullptr) {
      continue;
    }
    const std::uint64_t now_us = clock.move_to(frame->time_us);
    while (target.deadline_us() <= now_us) {
      target.tick(target.deadline_us());
    }
    target.take(*sensor,
                {.source_ipv4 = kReplayer,
                 .destination_port = datagram->destination_port,
                 .payload = datagram->payload},
                received, now_us);
  }
  target.tick(target.deadline_us());
}

}  // namespace iog::lab
