// What became of messages of service discovery. All wrap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::discovery {

enum class Count : std::uint8_t {
  kReceived,      // datagrams that came to the port of service discovery
  kMalformed,     // of these: not a message, or in fragments, or from outside of the subnet
  kSpoofed,       // in the subscriber's name from another station; or ARP names another one
  kFlooded,       // wanted an answer, for which the budget was spent
  kOffered,       // offers that were sent to the group
  kFound,         // questions for the service that were answered
  kAcknowledged,  // subscriptions, also renewed ones
  kRefused,       // subscriptions: a wrong endpoint, version, event group or instance, or no room
  kUnconfirmed,   // subscriptions whose host ARP did not find
  kStopped,       // subscriptions that their subscriber has ended
  kExpired,       // that ran out of time, or whose host has left
  kRebooted,      // that ended because their subscriber had started anew
  kCopied,        // messages that went to the subscriber
  kNotCopied,     // that did not, because the room belongs to the peer
};
inline constexpr std::size_t kCounts = 14;
static_assert(static_cast<std::size_t>(Count::kNotCopied) + 1 == kCounts);

struct Counts : std::array<std::uint32_t, kCounts> {
  // In the stream (stream/target_table.hpp).
  static constexpr auto kNames = std::to_array<std::string_view>(
      {"SD received", "SD malformed", "SD spoofed", "SD unanswered", "SD offers", "SD found",
       "SD subscriptions acknowledged", "SD subscriptions refused", "SD subscriptions unconfirmed",
       "SD subscriptions stopped", "SD subscriptions expired", "SD subscribers rebooted",
       "SD copied", "SD not copied"});
};

}  // namespace iog::discovery
