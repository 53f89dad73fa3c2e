// A small network host on one Ethernet port: frames in, datagrams out, messages to one peer.
//
// It answers ARP for its address to every host of its subnet, so that sensors can reach it. It
// answers ping to the peer alone, and of its own accord it sends messages to no other host:
// send_to() is told its destination. Besides the peer it may know one more host by ARP, the
// neighbour. It has no clock and no memory but the port's buffers; the memory for joining fragments
// is lent to it. Nothing else is copied on the way in. On the way out everything is copied once,
// and summed on the way: the port's memory is uncached, and reading it for the checksum would be
// slow.
//
// The loop calls poll() until it returns nothing, sends its messages, and calls the port's pump().
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

// A poll() that finds no datagram in this many frames returns, so that a flood of foreign frames
// cannot hold the loop: at 100 Mbit/s, 32 of the smallest frames arrive in 215 us.
inline constexpr int kMaxFramesPerPoll = 32;

template <hal::EthernetPort Port>
class Host {
 public:
  // `config` satisfies is_valid(). The port outlives the host and belongs to it.
  Host(Port& port, const Config& config) : port_{port}, config_{config} {}
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  // The next datagram addressed to us, valid until the next poll(). Nothing if none has come, or if
  // kMaxFramesPerPoll other frames came before it. `now_us` never goes backwards.
  [[nodiscard]] std::optional<Datagram> poll(std::uint64_t now_us);

  // From now on fragments are joined in this memory; until then they are dropped.
  void join_fragments(Reassembly& reassembly) { reassembly_ = &reassembly; }

  // True once the peer's Ethernet address has been learnt; stays true.
  [[nodiscard]] bool peer_known() const { return resolver_.known(); }

  // Sends the peer a copy of `payload`. False if nothing was sent, because the payload is longer
  // than kMaxUdpPayloadBytes, the peer unresolved or the transmit ring full (each counted).
  [[nodiscard]] bool send_message(std::span<const std::byte> payload);

  // The same to anybody, whose Ethernet address the caller knows.
  [[nodiscard]] bool send_to(const Destination& to, std::span<const std::byte> payload);

  // Another host of the subnet that ARP is to be asked for, or none any more.
  void know(std::optional<Ipv4Address> neighbour);

  // What ARP has told of the neighbour: its Ethernet address, and when it last did so.
  [[nodiscard]] std::optional<Told> neighbour() const;

  [[nodiscard]] const Counters& counters() const { return counters_; }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, config_);
  }

 private:
  // The front of a transmit buffer, empty if the ring is full.
  [[nodiscard]] std::optional<FrameBuffer> acquire();

  void release_frame();
  void request(PeerResolver& resolver, Ipv4Address host, std::uint64_t now_us);
  // The datagram that this fragment completes, or that it is kept, or dropped.
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
  PeerResolver neighbour_resolver_;  // of neighbour_, if there is one
  Counters counters_;
  Reassembly* reassembly_ = nullptr;
  std::uint16_t identification_ = 0;  // of the next IPv4 packet
  bool holds_frame_ = false;          // the datagram returned last is still in the port
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

// The first poll() asks at once. That also tells the network who we are, which QEMU's user network
// needs before it passes anything to us. A request that finds the ring full is not kept: the next
// one is due a second later.
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

// Whether it tells the Ethernet address of the peer or the neighbour.
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

// RFC 826, "Packet Reception": the sender is learnt first, then the request answered. A packet of
// the peer that asks for us does both and is counted as answered.
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

// The reply goes to the address that ARP told, not to wherever the request claims to come from.
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
