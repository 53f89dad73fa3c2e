// Plays a capture into a target, in the order and by the clock of `iog fuse`
// (tools/fuse/offline_target.hpp), so that both see the same frames.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "capture.hpp"
#include "instruction_counter.hpp"
#include "intake/datagram.hpp"
#include "net/ethernet.hpp"
#include "net/ipv4.hpp"
#include "net/udp.hpp"
#include "tools/formats/capture/capture_clock.hpp"
#include "vehicle/vehicle.hpp"
#include "wire.hpp"

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

// The next frame's datagram, through the port's uncached memory as on the target. A capture may
// hold frames that are longer than those of Ethernet, as of a loopback device; these are read in
// place.
inline std::optional<net::Datagram> receive(const CapturedFrame& frame, bool fits) {
  return datagram_in(fits ? Wire::of_machine().receive() : frame.bytes);
}

// Target: take(datagram, instructions spent on receiving it, now), tick(now), deadline_us(). It
// gets the datagrams to ports that are_played(port). After the capture the open frame times out.
template <typename ArePlayed, typename Target>
void play_ports(Capture& capture, ArePlayed&& are_played, InstructionCounter& counter,
                Target& target) {
  tools::CaptureClock clock;
  while (const auto frame = capture.next()) {
    const bool fits = Wire::of_machine().deliver(frame->bytes);
    const std::uint32_t start = counter.now();
    const auto datagram = receive(*frame, fits);
    const std::uint32_t received = counter.now() - start - counter.of_nothing();
    if (!datagram || !are_played(datagram->destination_port)) {
      continue;
    }
    const std::uint64_t now_us = clock.move_to(frame->time_us);
    while (target.deadline_us() <= now_us) {
      target.tick(target.deadline_us());
    }
    target.take({.source_ipv4 = kReplayer,
                 .destination_port = datagram->destination_port,
                 .payload = datagram->payload},
                received, now_us);
  }
  target.tick(target.deadline_us());
}

// A target of play_ports() that is told which sensor a datagram is of.
template <typename Target>
class BySensor {
 public:
  BySensor(const vehicle::Vehicle& vehicle, Target& target) : vehicle_(vehicle), target_(target) {}

  void take(const intake::Datagram& datagram, std::uint32_t received, std::uint64_t now_us) {
    target_.take(*sensor_of_port(vehicle_, datagram.destination_port), datagram, received, now_us);
  }
  void tick(std::uint64_t now_us) { target_.tick(now_us); }
  [[nodiscard]] std::uint64_t deadline_us() const { return target_.deadline_us(); }

 private:
  const vehicle::Vehicle& vehicle_;
  Target& target_;
};

// The datagrams of a vehicle's sensors. Target: take(sensor, datagram, ...) and the rest as above.
template <typename Target>
void play(Capture& capture, const vehicle::Vehicle& vehicle, InstructionCounter& counter,
          Target& target) {
  BySensor by_sensor(vehicle, target);
  play_ports(
      capture, [&vehicle](std::uint16_t port) { return sensor_of_port(vehicle, port) != nullptr; },
      counter, by_sensor);
}

}  // namespace iog::lab
