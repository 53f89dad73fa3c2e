// The service that a target offers. If the service is enabled, the target runs service discovery
// and sends a copy of each message to the subscriber. Otherwise, the target sends messages only to
// its peer.
//
// Messages to the peer have priority over the copies. A frame is expected to have at most
// kMostMessages messages. The target sends a copy only if enough buffers remain for the rest of the
// frame's messages to the peer. The port's ring is enlarged to make room for the copies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "discovery/server.hpp"
#include "hal/ethernet_port.hpp"
#include "net/config.hpp"
#include "net/host.hpp"
#include "stream/channel.hpp"

namespace iog::app {

template <hal::EthernetPort Port>
class Offering {
 public:
  // The expected maximum number of messages per frame. This number allows for a complete grid of
  // raw tiles and for other messages that may be sent at the same time.
  static constexpr std::size_t kMostMessages = 1024 + 64;
  // The minimum number of buffers that stay reserved for the peer, even if a frame has more
  // messages than expected.
  static constexpr std::size_t kLeastRoom = 64;

  // `port` and `host` must outlive this object. `run_number` seeds the random delay before the
  // first offer.
  Offering(Port& port, net::Host<Port>& host, const net::Config& config, std::uint32_t run_number)
      : port_(port),
        host_(host),
        is_on_(config.service_instance != 0),
        server_(config,
                {.service = stream::kServiceId,
                 .major = stream::kInterfaceVersion,
                 .minor = stream::kMinorVersion,
                 .event_group = stream::kEventGroup},
                scattered(run_number ^ config.address.value)) {}

  [[nodiscard]] bool is_on() const { return is_on_; }
  [[nodiscard]] const discovery::Counts& counts() const { return server_.counts(); }

  // If the datagram is a service discovery message, answers it and returns true.
  [[nodiscard]] bool take(const net::Datagram& datagram, std::uint64_t now_us) {
    if (!is_on_ || datagram.destination_port != net::kDiscoveryPort) {
      return false;
    }
    send(server_.receive(datagram, now_us));
    return true;
  }

  // Sends messages that are due.
  void tick(std::uint64_t now_us) {
    if (is_on_) {
      host_.know(server_.neighbour());
      send(server_.tick(now_us, host_.neighbour()));
    }
  }

  // Withdraws the offer. Call this function once, before the run ends. The message is sent
  // immediately if the controller accepts it.
  void withdraw() {
    if (is_on_) {
      send(server_.withdraw());
      port_.pump();
    }
  }

  // Marks the next message as the first message of a frame.
  void begin_frame() { messages_ = 0; }

  // Sends the message to the peer and then to the subscriber. Returns true if at least one of the
  // two transmissions succeeded.
  [[nodiscard]] bool send_message(std::span<const std::byte> message) {
    const bool is_sent = host_.send_message(message);
    ++messages_;
    return copy(message) || is_sent;
  }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, is_on_);
    server_.for_each_constant(visit);
  }

 private:
  // Spreads adjacent numbers far apart (Knuth, The Art of Computer Programming, 6.4).
  static constexpr std::uint32_t scattered(std::uint32_t number) { return number * 2'654'435'761U; }

  [[nodiscard]] bool copy(std::span<const std::byte> message) {
    const auto subscriber = is_on_ ? server_.subscriber() : std::nullopt;
    if (!subscriber) {
      return false;
    }
    const bool is_copied = port_.room() > room_of_peer() && host_.send_to(*subscriber, message);
    server_.count(is_copied ? discovery::Count::kCopied : discovery::Count::kNotCopied);
    return is_copied;
  }

  [[nodiscard]] std::size_t room_of_peer() const {
    return messages_ + kLeastRoom < kMostMessages ? kMostMessages - messages_ : kLeastRoom;
  }

  void send(const std::optional<discovery::Outgoing>& outgoing) {
    if (outgoing) {
      static_cast<void>(host_.send_to(outgoing->to, outgoing->view()));
    }
  }

  Port& port_;
  net::Host<Port>& host_;
  bool is_on_;
  discovery::Server server_;
  std::size_t messages_ = 0;  // of the current frame
};

}  // namespace iog::app
