// Counts the outcomes of service discovery messages. All counters wrap around.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::discovery {

enum class Count : std::uint8_t {
  kReceived,      // received datagrams for the service discovery port
  kMalformed,     // received datagrams that were invalid, fragmented, or from outside the subnet
  kSpoofed,       // sender's Ethernet address contradicted the subscription or ARP
  kFlooded,       // unanswered because no answer tokens were left
  kOffered,       // offers multicast to the group
  kFound,         // find entries that were answered
  kAcknowledged,  // subscriptions acknowledged, renewals included
  kRefused,       // subscriptions refused: bad endpoint, version, event group, instance; no slot
  kUnconfirmed,   // subscriptions refused because their host did not answer ARP
  kStopped,       // subscriptions stopped by the subscriber
  kExpired,       // subscriptions that timed out, or whose host has left
  kRebooted,      // subscriptions that ended because the subscriber rebooted
  kCopied,        // stream messages sent to the subscriber
  kNotCopied,     // stream messages not sent to the subscriber; the peer had priority
};
inline constexpr std::size_t kCounts = 14;
static_assert(static_cast<std::size_t>(Count::kNotCopied) + 1 == kCounts);

struct Counts : std::array<std::uint32_t, kCounts> {
  // The names of the counters in the stream (stream/target_table.hpp).
  static constexpr auto kNames = std::to_array<std::string_view>(
      {"SD received", "SD malformed", "SD spoofed", "SD unanswered", "SD offers", "SD found",
       "SD subscriptions acknowledged", "SD subscriptions refused", "SD subscriptions unconfirmed",
       "SD subscriptions stopped", "SD subscriptions expired", "SD subscribers rebooted",
       "SD copied", "SD not copied"});
};

}  // namespace iog::discovery
