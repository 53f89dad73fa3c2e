#include "discovery/server.hpp"

#include "net/address.hpp"

namespace iog::discovery {
namespace {

constexpr std::uint64_t kSecondUs = 1'000'000;

net::Destination back_to(const net::Datagram& datagram) {
  return {.mac = datagram.station,
          .address = datagram.source,
          .port = datagram.source_port,
          .source_port = net::kDiscoveryPort};
}

// Counter and event group of a subscription. The higher bits are reserved.
constexpr std::uint32_t kCounterAndEventGroup = 0x000F'FFFF;

// The acknowledgement of a subscription: ttl_s is the requested lifetime, or 0 to refuse.
Entry answer_to(Entry entry, std::uint32_t ttl_s) {
  entry.type = EntryType::kSubscribeAck;
  entry.options = {};
  entry.ttl_s = ttl_s;
  entry.minor &= kCounterAndEventGroup;
  return entry;
}

}  // namespace

std::optional<Outgoing> Server::receive(const net::Datagram& datagram, std::uint64_t now_us) {
  count(Count::kReceived);
  const bool is_host =
      net::is_host_in_subnet(datagram.source, config_.address, config_.prefix_bits);
  const auto message = read_message(datagram.payload);
  if (!message || !is_host || datagram.source_port == 0 || !datagram.station.is_unicast()) {
    count(Count::kMalformed);
    return std::nullopt;
  }
  if (subscription_ && datagram.source == subscription_->endpoint.address &&
      datagram.station != subscription_->partner.mac) {
    count(Count::kSpoofed);
    return std::nullopt;
  }
  AnswerBudget& budget = is_of_subscriber(datagram) ? subscribers_ : strangers_;
  look_for_reboot(*message, datagram);
  if (schedule_.is_waiting() || !concerns_us(*message)) {
    return std::nullopt;
  }
  if (!budget.take(now_us)) {
    count(Count::kFlooded);
    return std::nullopt;
  }
  const Answer answer = answer_of(*message, datagram, now_us);
  if (answer.count == 0) {
    return std::nullopt;
  }
  return message_to(back_to(datagram), to_one_, std::span(answer.entries).first(answer.count));
}

// Answers entries in order. One offer answers all find entries.
Server::Answer Server::answer_of(const Message& message, const net::Datagram& datagram,
                                 std::uint64_t now_us) {
  Answer answer;
  bool is_offered = false;
  std::size_t subscriptions = 0;
  for (std::size_t i = 0; i < message.entry_count(); ++i) {
    const Entry entry = message.entry(i);
    if (is_wanted(entry) && !is_offered) {
      is_offered = true;
      answer.add(offer(kOfferTtlS));
      count(Count::kFound);
    }
    if (!is_subscription(entry)) {
      continue;
    }
    if (++subscriptions > kMaxSubscriptionsPerMessage || datagram.destination != config_.address) {
      count(Count::kRefused);
      continue;
    }
    take_subscription(message, entry, datagram, now_us, answer);
  }
  return answer;
}

// True if a find entry asks for our service.
bool Server::is_wanted(const Entry& entry) const {
  return entry.type == EntryType::kFind && entry.service == service_.service &&
         (entry.instance == config_.service_instance || entry.instance == kAnyInstance) &&
         (entry.major == service_.major || entry.major == kAnyMajor) &&
         (entry.minor == service_.minor || entry.minor == kAnyMinor);
}

bool Server::is_subscription(const Entry& entry) const {
  return entry.type == EntryType::kSubscribe && entry.service == service_.service;
}

bool Server::concerns_us(const Message& message) const {
  for (std::size_t i = 0; i < message.entry_count(); ++i) {
    const Entry entry = message.entry(i);
    if (is_wanted(entry) || is_subscription(entry)) {
      return true;
    }
  }
  return false;
}

// receive() has already dropped datagrams with the subscriber's address from another station.
bool Server::is_of_subscriber(const net::Datagram& datagram) const {
  return subscription_ && datagram.source == subscription_->endpoint.address;
}

// After a reboot the subscriber no longer knows its subscription.
void Server::look_for_reboot(const Message& message, const net::Datagram& datagram) {
  if (!is_of_subscriber(datagram)) {
    return;
  }
  SessionWatch& watch =
      datagram.destination == config_.address ? subscription_->by_unicast : subscription_->by_group;
  if (watch.is_rebooted(session_of(message))) {
    end(Count::kRebooted);
  }
}

// Only the sender itself can be the endpoint, so no host can direct the stream to another.
bool Server::is_acceptable(const Entry& entry, const std::optional<Endpoint>& endpoint,
                           const net::Datagram& datagram) const {
  return entry.instance == config_.service_instance && entry.major == service_.major &&
         entry.event_group() == service_.event_group && endpoint &&
         endpoint->address == datagram.source && endpoint->port != 0;
}

// True if there is no subscription, if its candidate has timed out, or if it has this endpoint.
// is_acceptable() has already compared the endpoint's address with the sender's.
bool Server::has_room_for(const Endpoint& endpoint, std::uint64_t now_us) const {
  if (!subscription_ ||
      (!subscription_->is_confirmed && now_us - subscription_->since_us >= kConfirmUs)) {
    return true;
  }
  return subscription_->endpoint == endpoint;
}

void Server::take_subscription(const Message& message, const Entry& entry,
                               const net::Datagram& datagram, std::uint64_t now_us,
                               Answer& answer) {
  if (entry.ttl_s == 0) {
    stop(entry, datagram);
    return;
  }
  const auto endpoint = message.udp_endpoint_of(entry);
  if (!is_acceptable(entry, endpoint, datagram) || !has_room_for(*endpoint, now_us)) {
    count(Count::kRefused);
    answer.add(answer_to(entry, 0));
    return;
  }
  if (subscription_ && subscription_->endpoint == *endpoint) {
    subscription_->entry = entry;
    subscription_->partner = back_to(datagram);
    if (subscription_->is_confirmed) {
      subscription_->since_us = now_us;
      count(Count::kAcknowledged);
      answer.add(answer_to(entry, entry.ttl_s));
    }
    return;
  }
  subscription_ = Subscription{
      .endpoint = *endpoint, .partner = back_to(datagram), .entry = entry, .since_us = now_us};
  static_cast<void>(subscription_->by_unicast.is_rebooted(session_of(message)));
}

// A host cannot end the subscription of another host. Its port is not compared: there is only one
// subscription.
void Server::stop(const Entry& entry, const net::Datagram& datagram) {
  if (is_of_subscriber(datagram) && entry.instance == config_.service_instance &&
      entry.event_group() == service_.event_group) {
    end(Count::kStopped);
  }
}

void Server::end(Count why) {
  subscription_.reset();
  count(why);
}

std::optional<Outgoing> Server::tick(std::uint64_t now_us, const std::optional<net::Told>& told) {
  if (subscription_ && !subscription_->is_confirmed) {
    if (auto acknowledgement = confirm(now_us, told)) {
      return acknowledgement;
    }
  } else if (subscription_) {
    look_at(now_us, told);
  }
  if (schedule_.take_due(now_us)) {
    count(Count::kOffered);
    return to_group(kOfferTtlS);
  }
  return std::nullopt;
}

// A candidate becomes the subscriber if ARP gives the station that sent its subscription.
std::optional<Outgoing> Server::confirm(std::uint64_t now_us,
                                        const std::optional<net::Told>& told) {
  if (!told) {
    if (now_us - subscription_->since_us >= kConfirmUs) {
      end(Count::kUnconfirmed);
    }
    return std::nullopt;
  }
  if (told->mac != subscription_->partner.mac) {
    end(Count::kSpoofed);
    return std::nullopt;
  }
  subscription_->is_confirmed = true;
  subscription_->since_us = now_us;
  count(Count::kAcknowledged);
  const Entry entry = answer_to(subscription_->entry, subscription_->entry.ttl_s);
  return message_to(subscription_->partner, to_one_, std::span(&entry, 1));
}

void Server::look_at(std::uint64_t now_us, const std::optional<net::Told>& told) {
  const std::uint32_t ttl_s = subscription_->entry.ttl_s;
  const bool is_over = ttl_s != kForeverS && now_us - subscription_->since_us >= ttl_s * kSecondUs;
  if (is_over || !told || now_us - told->at_us >= kLeftUs) {
    end(Count::kExpired);
  } else if (told->mac != subscription_->partner.mac) {
    end(Count::kSpoofed);
  }
}

Outgoing Server::withdraw() { return to_group(0); }

Entry Server::offer(std::uint32_t ttl_s) const {
  return {.type = EntryType::kOffer,
          .options = {{{.first = 0, .count = 1}, {}}},
          .service = service_.service,
          .instance = config_.service_instance,
          .major = service_.major,
          .ttl_s = ttl_s,
          .minor = service_.minor};
}

Outgoing Server::to_group(std::uint32_t ttl_s) {
  const Entry entry = offer(ttl_s);
  return message_to({.mac = net::kDiscoveryGroupMac,
                     .address = net::kDiscoveryGroup,
                     .port = net::kDiscoveryPort,
                     .source_port = net::kDiscoveryPort},
                    to_all_, std::span(&entry, 1));
}

Outgoing Server::message_to(const net::Destination& to, SessionCounter& sessions,
                            std::span<const Entry> entries) const {
  const Session session = sessions.take();
  const auto flags = static_cast<std::uint8_t>(kFlagUnicast | (session.reboot ? kFlagReboot : 0U));
  Outgoing outgoing{.to = to};
  outgoing.bytes =
      write_message(session.id, flags, entries,
                    {.address = config_.address, .port = config_.source_port}, outgoing.buffer);
  return outgoing;
}

std::optional<net::Ipv4Address> Server::neighbour() const {
  return subscription_ ? std::optional(subscription_->endpoint.address) : std::nullopt;
}

std::optional<net::Destination> Server::subscriber() const {
  if (!subscription_ || !subscription_->is_confirmed ||
      subscription_->endpoint == Endpoint{config_.peer, config_.peer_port}) {
    return std::nullopt;
  }
  return net::Destination{.mac = subscription_->partner.mac,
                          .address = subscription_->endpoint.address,
                          .port = subscription_->endpoint.port,
                          .source_port = config_.source_port};
}

}  // namespace iog::discovery
