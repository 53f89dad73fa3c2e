// The server's side of SOME/IP service discovery, for one service with one event group and one
// subscriber. No I/O and no clock of its own: datagrams and time go in, messages come out.
//
// A subscriber has shown that it is where it says: its endpoint is the very host that its
// subscription came from, and ARP names the station that has sent it. Until ARP has answered it is
// a candidate, without an acknowledgement and without a message.
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

// What is offered, at our address and the port that messages come from.
struct Service {
  std::uint16_t service = 0;
  std::uint8_t major = 0;
  std::uint32_t minor = 0;
  std::uint16_t event_group = 0;
};

// Subscriptions of one datagram that are looked at; those behind them are refused without a word.
inline constexpr std::size_t kMaxSubscriptionsPerMessage = 4;

// How long ARP has to find a candidate.
inline constexpr std::uint32_t kConfirmUs = 500'000;

// A subscriber that ARP has not found for so long has left. It is asked for every 30 s, and then
// every second (net/peer_resolver.hpp).
inline constexpr std::uint64_t kLeftUs = 40'000'000;

// A message on its way.
struct Outgoing {
  net::Destination to{};
  std::size_t bytes = 0;
  // An offer and the answers to subscriptions.
  std::array<std::byte, message_bytes(1 + kMaxSubscriptionsPerMessage)> buffer{};

  [[nodiscard]] std::span<const std::byte> view() const { return std::span(buffer).first(bytes); }
};

class Server {
 public:
  // noise: of this run, for the first delay.
  Server(const net::Config& config, const Service& service, std::uint32_t noise)
      : config_(config), service_(service), schedule_(noise) {}

  // A datagram to kDiscoveryPort; what it is answered with, if it is.
  [[nodiscard]] std::optional<Outgoing> receive(const net::Datagram& datagram,
                                                std::uint64_t now_us);

  // Time has passed; what is due. told: what ARP has told of neighbour(), if it has.
  [[nodiscard]] std::optional<Outgoing> tick(std::uint64_t now_us,
                                             const std::optional<net::Told>& told);

  // The withdrawal of the offer. Nothing follows it.
  [[nodiscard]] Outgoing withdraw();

  // Whom ARP is to be asked for.
  [[nodiscard]] std::optional<net::Ipv4Address> neighbour() const;

  // The host that gets a copy of each message. Not a subscriber that is the peer, which gets them
  // anyway.
  [[nodiscard]] std::optional<net::Destination> subscriber() const;

  void count(Count what) { ++counts_[static_cast<std::size_t>(what)]; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, config_, service_);
  }

 private:
  struct Subscription {
    Endpoint endpoint{};         // where messages go
    net::Destination partner{};  // the subscriber: where answers go
    Entry entry{};               // of the newest subscription
    std::uint64_t since_us = 0;  // the candidate, or the newest renewal
    bool is_confirmed = false;
    SessionWatch by_group{};
    SessionWatch by_unicast{};
  };
  // The entries of an answer.
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
  SessionCounter to_one_;  // every receiver sees ids that rise
  AnswerBudget strangers_;
  AnswerBudget subscribers_;
  std::optional<Subscription> subscription_;
  Counts counts_{};
};

}  // namespace iog::discovery
