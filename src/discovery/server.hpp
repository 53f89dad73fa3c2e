// The server of SOME/IP service discovery for one service, with one event group and one subscriber.
// The server performs no I/O and reads no clock. Callers pass datagrams and times to the server and
// send the messages that it returns.
//
// A subscriber must prove that it owns its address. The endpoint's IP address must be the source
// address of the subscription, and ARP must resolve it to the Ethernet address from which the
// subscription was sent. Until the host has answered an ARP request, it is a candidate and receives
// neither an acknowledgement nor messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "discovery/answer_budget.hpp"
#include "discovery/counters.hpp"
#include "discovery/message.hpp"
#include "discovery/offer_schedule.hpp"
#include "discovery/sessions.hpp"
#include "health/constants.hpp"
#include "net/config.hpp"
#include "net/outbound.hpp"
#include "net/peer_resolver.hpp"
#include "net/udp.hpp"

namespace iog::discovery {

// The offered service. The service's endpoint consists of the target's address and the source port
// of the messages.
struct Service {
  std::uint16_t service = 0;
  std::uint8_t major = 0;
  std::uint32_t minor = 0;
  std::uint16_t event_group = 0;
};

// The maximum number of subscriptions handled per datagram. Further subscriptions are rejected
// without an answer.
inline constexpr std::size_t kMaxSubscriptionsPerMessage = 4;

// The time within which ARP must confirm a candidate.
inline constexpr std::uint32_t kConfirmUs = 500'000;

// If a subscriber has not answered ARP requests for kLeftUs, it is assumed to have left. The first
// ARP request is sent after 30 s, followed by one request per second (net/peer_resolver.hpp).
inline constexpr std::uint64_t kLeftUs = 40'000'000;

// A message to be sent.
struct Outgoing {
  net::Destination to{};
  std::size_t bytes = 0;
  // The buffer for an offer and the answers to subscriptions.
  std::array<std::byte, message_bytes(1 + kMaxSubscriptionsPerMessage)> buffer{};

  [[nodiscard]] std::span<const std::byte> view() const { return std::span(buffer).first(bytes); }
};

class Server {
 public:
  // `noise` is a random value that differs in each run and determines the initial delay.
  Server(const net::Config& config, const Service& service, std::uint32_t noise)
      : config_(config), service_(service), schedule_(noise) {}

  // Handles a datagram sent to kDiscoveryPort. Returns the answer, if there is one.
  [[nodiscard]] std::optional<Outgoing> receive(const net::Datagram& datagram,
                                                std::uint64_t now_us);

  // Advances the time, and returns a message if one is due. `told` is the result of resolving
  // neighbour() with ARP, if available.
  [[nodiscard]] std::optional<Outgoing> tick(std::uint64_t now_us,
                                             const std::optional<net::Told>& told);

  // Returns the stop-offer message, which must be the last message sent.
  [[nodiscard]] Outgoing withdraw();

  // Returns the host that ARP should resolve.
  [[nodiscard]] std::optional<net::Ipv4Address> neighbour() const;

  // Returns the host that receives a copy of each stream message. Returns nothing if the subscriber
  // is the peer, because the peer receives the messages anyway.
  [[nodiscard]] std::optional<net::Destination> subscriber() const;

  void count(Count what) { ++counts_[static_cast<std::size_t>(what)]; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, config_, service_);
  }

 private:
  struct Subscription {
    Endpoint endpoint{};         // destination of stream messages
    net::Destination partner{};  // the subscriber, which is the destination of answers
    Entry entry{};               // entry of the latest subscription
    std::uint64_t since_us = 0;  // time at which it became a candidate or last renewed
    bool is_confirmed = false;
    SessionWatch by_group{};
    SessionWatch by_unicast{};
  };
  // The entries of an answer message.
  struct Answer {
    std::array<Entry, 1 + kMaxSubscriptionsPerMessage> entries{};
    std::size_t count = 0;
    void add(const Entry& entry) { entries[count++] = entry; }
  };

  [[nodiscard]] bool is_wanted(const Entry& entry) const;
  [[nodiscard]] bool is_subscription(const Entry& entry) const;
  [[nodiscard]] bool concerns_us(const Message& message) const;
  [[nodiscard]] Answer answer_of(const Message& message, const net::Datagram& datagram,
                                 std::uint64_t now_us);
  [[nodiscard]] bool is_acceptable(const Entry& entry, const std::optional<Endpoint>& endpoint,
                                   const net::Datagram& datagram) const;
  [[nodiscard]] bool is_of_subscriber(const net::Datagram& datagram) const;
  void look_for_reboot(const Message& message, const net::Datagram& datagram);
  void take_subscription(const Message& message, const Entry& entry, const net::Datagram& datagram,
                         std::uint64_t now_us, Answer& answer);
  void stop(const Entry& entry, const net::Datagram& datagram);
  [[nodiscard]] bool has_room_for(const Endpoint& endpoint, std::uint64_t now_us) const;
  void end(Count why);
  [[nodiscard]] std::optional<Outgoing> confirm(std::uint64_t now_us,
                                                const std::optional<net::Told>& told);
  void look_at(std::uint64_t now_us, const std::optional<net::Told>& told);
  [[nodiscard]] Entry offer(std::uint32_t ttl_s) const;
  [[nodiscard]] Outgoing to_group(std::uint32_t ttl_s);
  [[nodiscard]] Outgoing message_to(const net::Destination& to, SessionCounter& sessions,
                                    std::span<const Entry> entries) const;

  net::Config config_;
  Service service_;
  OfferSchedule schedule_;
  SessionCounter to_all_;
  SessionCounter to_one_;  // shared by all unicast receivers: each receiver sees ascending ids
  AnswerBudget strangers_;
  AnswerBudget subscribers_;
  std::optional<Subscription> subscription_;
  Counts counts_{};
};

}  // namespace iog::discovery
