// A small network host on one Ethernet port. The host receives datagrams and sends messages to one
// peer. Pings are answered only if they come from the peer. ARP requests from every host in the
// subnet are answered, so that sensors can reach the target.
//
// `send_message()` sends only to the peer, while send_to() sends to any destination. The host can
// also use ARP to resolve the address of one more host, called the neighbour.
//
// The host reads no clock, and its only buffers are those of the port. Received data is copied only
// for reassembly. Sent data is copied once, and its checksum is computed during the copy. The
// port's memory is uncached, so reading the data back would be slow.
//
// In each iteration, the main loop calls poll() until it returns nothing, sends its messages, and
// then calls the port's pump().
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/ethernet_port.hpp"
#include "health/constants.hpp"
#include "net/config.hpp"
#include "net/counters.hpp"
#include "net/inbound.hpp"
#include "net/outbound.hpp"
#include "net/peer_resolver.hpp"
#include "net/reassembly.hpp"

namespace iog::net {

// `poll()` returns if kMaxFramesPerPoll frames in a row yield no datagram, so a flood of unrelated
// frames cannot block the loop. At 100 Mbit/s, 32 frames of the minimum size arrive in 215 us.
inline constexpr int kMaxFramesPerPoll = 32;

template <hal::EthernetPort Port>
class Host {
 public:
  // `is_valid(config)` must be true. The host has exclusive use of the port. The port must outlive
  // the host.
  Host(Port& port, const Config& config) : port_{port}, config_{config} {}
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  // Returns the next datagram addressed to us. The datagram is valid until the next call to poll().
  // Returns nothing if no datagram has arrived, or if kMaxFramesPerPoll frames in a row yield no
  // datagram. `now_us` must not decrease.
  [[nodiscard]] std::optional<Datagram> poll(std::uint64_t now_us);

  // Sets the memory in which fragments are reassembled. Before this call, all fragments are
  // dropped.
  void join_fragments(Reassembly& reassembly) { reassembly_ = &reassembly; }

  // Returns true if the peer's Ethernet address is known.
  [[nodiscard]] bool peer_known() const { return resolver_.known(); }

  // Sends a copy of `payload` to the peer. Returns false and increments the counter for the cause
  // if the payload is longer than kMaxUdpPayloadBytes, the peer is unresolved, or the transmit ring
  // is full. Nothing is sent in these cases.
  [[nodiscard]] bool send_message(std::span<const std::byte> payload);

  // Sends a copy of `payload` to a destination whose Ethernet address the caller knows.
  [[nodiscard]] bool send_to(const Destination& to, std::span<const std::byte> payload);

  // Sets or clears the neighbour. The neighbour is another host in the subnet, whose address ARP
  // resolves.
  void know(std::optional<Ipv4Address> neighbour);

  // Returns the neighbour's Ethernet address and the time at which ARP last confirmed it.
  [[nodiscard]] std::optional<Told> neighbour() const;

  [[nodiscard]] const Counters& counters() const { return counters_; }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, config_);
  }

 private:
  // Returns the first kMaxFrameBytes bytes of a free transmit buffer, or nothing if the ring is
  // full.
  [[nodiscard]] std::optional<FrameBuffer> acquire();

  void release_frame();
  void request(PeerResolver& resolver, Ipv4Address host, std::uint64_t now_us);
  // If `fragment` completes a datagram, returns this datagram. Otherwise, stores or drops the
  // fragment and returns nothing.
  [[nodiscard]] std::optional<Datagram> take_fragment(const Ipv4Packet& fragment,
                                                      std::uint64_t now_us);
  [[nodiscard]] bool learn(const ArpPacket& packet, std::uint64_t now_us);
  void answer_arp(const ArpPacket& packet, std::uint64_t now_us);
  void answer_ping(std::span<const std::byte> request);
  void drop(Drop cause) { ++counters_.of(cause); }

  Port& port_;
  Config config_;
  PeerResolver resolver_;
  std::optional<Ipv4Address> neighbour_;
  PeerResolver neighbour_resolver_;  // resolver for neighbour_, if that is set
  Counters counters_;
  Reassembly* reassembly_ = nullptr;
  std::uint16_t identification_ = 0;  // identification of the next IPv4 packet
  bool holds_frame_ = false;          // the port's buffer still contains the last datagram returned
};

template <hal::EthernetPort Port>
std::optional<Datagram> Host<Port>::poll(std::uint64_t now_us) {
  release_frame();
  request(resolver_, config_.peer, now_us);
  if (neighbour_) {
    request(neighbour_resolver_, *neighbour_, now_us);
  }
  for (int frames = 0; frames < kMaxFramesPerPoll; ++frames) {
    const std::span<const std::byte> frame = port_.receive();
    if (frame.empty()) {
      return std::nullopt;
    }
    holds_frame_ = true;
    ++counters_.received;
    const Inbound inbound = classify_frame(frame, config_);
    if (inbound.peer_mac) {
      resolver_.hear(*inbound.peer_mac);
    }
    switch (inbound.kind) {
      case InboundKind::kDatagram:
        ++counters_.delivered;
        return inbound.datagram;
      case InboundKind::kFragment:
        if (const auto datagram = take_fragment(inbound.fragment, now_us)) {
          return datagram;
        }
        break;
      case InboundKind::kArp:
        answer_arp(inbound.arp, now_us);
        break;
      case InboundKind::kEchoRequest:
        answer_ping(inbound.echo_request);
        break;
      case InboundKind::kDropped:
        drop(inbound.drop);
        break;
    }
    release_frame();
  }
  return std::nullopt;
}

template <hal::EthernetPort Port>
std::optional<Datagram> Host<Port>::take_fragment(const Ipv4Packet& fragment,
                                                  std::uint64_t now_us) {
  if (reassembly_ == nullptr) {
    drop(Drop::kFragment);
    return std::nullopt;
  }
  const Reassembly::Result result = reassembly_->add(fragment, now_us, counters_.fragments);
  if (result.fate == Reassembly::Fate::kJoined) {
    return std::nullopt;
  }
  if (result.fate == Reassembly::Fate::kDropped) {
    drop(Drop::kFragment);
    return std::nullopt;
  }
  const Inbound inbound = classify_joined(result.packet);
  if (inbound.kind != InboundKind::kDatagram) {
    drop(inbound.drop);
    return std::nullopt;
  }
  ++counters_.delivered;
  return inbound.datagram;
}

template <hal::EthernetPort Port>
bool Host<Port>::send_message(std::span<const std::byte> payload) {
  if (payload.size() > kMaxUdpPayloadBytes) {
    ++counters_.of(Refusal::kMisuse);
    return false;
  }
  if (!resolver_.known()) {
    ++counters_.of(Refusal::kUnresolved);
    return false;
  }
  if (!send_to({.mac = resolver_.mac(),
                .address = config_.peer,
                .port = config_.peer_port,
                .source_port = config_.source_port},
               payload)) {
    return false;
  }
  ++counters_.sent;
  return true;
}

template <hal::EthernetPort Port>
bool Host<Port>::send_to(const Destination& to, std::span<const std::byte> payload) {
  if (payload.size() > kMaxUdpPayloadBytes) {
    ++counters_.of(Refusal::kMisuse);
    return false;
  }
  const auto buffer = acquire();
  if (!buffer) {
    ++counters_.of(Refusal::kRingFull);
    return false;
  }
  port_.commit(build_datagram(*buffer, config_, to, identification_++, payload));
  return true;
}

template <hal::EthernetPort Port>
void Host<Port>::know(std::optional<Ipv4Address> neighbour) {
  if (neighbour != neighbour_) {
    neighbour_ = neighbour;
    neighbour_resolver_ = {};
  }
}

template <hal::EthernetPort Port>
std::optional<Told> Host<Port>::neighbour() const {
  return neighbour_ ? neighbour_resolver_.told() : std::nullopt;
}

template <hal::EthernetPort Port>
std::optional<FrameBuffer> Host<Port>::acquire() {
  const std::span<std::byte> buffer = port_.acquire();
  if (buffer.size() < kMaxFrameBytes) {
    return std::nullopt;
  }
  return buffer.first<kMaxFrameBytes>();
}

template <hal::EthernetPort Port>
void Host<Port>::release_frame() {
  if (holds_frame_) {
    port_.release();
    holds_frame_ = false;
  }
}

// Sends an ARP request if one is due. The first call to poll() immediately sends a request, which
// also announces the target. QEMU's user network does not forward frames to the target until the
// target has sent this request. If the ring is full, the request is lost, and the next one is due a
// second later.
template <hal::EthernetPort Port>
void Host<Port>::request(PeerResolver& resolver, Ipv4Address host, std::uint64_t now_us) {
  const std::optional<MacAddress> whom = resolver.request_due(now_us);
  if (!whom) {
    return;
  }
  if (const auto buffer = acquire()) {
    port_.commit(build_arp_request(*buffer, config_, host, *whom));
    ++counters_.arp_requested;
  }
}

// Returns true if the packet contains the Ethernet address of the peer or the neighbour.
template <hal::EthernetPort Port>
bool Host<Port>::learn(const ArpPacket& packet, std::uint64_t now_us) {
  const bool tells_peer = tells_mac_of(config_.peer, packet, config_);
  if (tells_peer) {
    resolver_.learn(packet.sender_mac, now_us);
  }
  const bool tells_neighbour = neighbour_ && tells_mac_of(*neighbour_, packet, config_);
  if (tells_neighbour) {
    neighbour_resolver_.learn(packet.sender_mac, now_us);
  }
  return tells_peer || tells_neighbour;
}

// The sender's address is learned before the request is answered (RFC 826, "Packet Reception"). If
// a request from the peer both updates the peer's address and is answered, only the answer is
// counted.
template <hal::EthernetPort Port>
void Host<Port>::answer_arp(const ArpPacket& packet, std::uint64_t now_us) {
  if (claims_our_address(packet, config_)) {
    drop(Drop::kAddressConflict);
    return;
  }
  const bool is_learnt = learn(packet, now_us);
  if (!asks_for_us(packet, config_)) {
    if (is_learnt) {
      ++counters_.arp_learned;
    } else {
      drop(Drop::kArpIgnored);
    }
    return;
  }
  const auto buffer = acquire();
  if (!buffer) {
    drop(Drop::kReplyRingFull);
    return;
  }
  port_.commit(build_arp_reply(*buffer, config_, packet));
  ++counters_.arp_answered;
}

// The reply is sent to the address that was learned through ARP, not to the source address of the
// request.
template <hal::EthernetPort Port>
void Host<Port>::answer_ping(std::span<const std::byte> request) {
  if (!resolver_.known()) {
    drop(Drop::kPingIgnored);
    return;
  }
  const auto buffer = acquire();
  if (!buffer) {
    drop(Drop::kReplyRingFull);
    return;
  }
  port_.commit(build_echo_reply(*buffer, config_, resolver_.mac(), identification_++, request));
  ++counters_.ping_answered;
}

}  // namespace iog::net
