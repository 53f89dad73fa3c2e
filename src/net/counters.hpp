// Counts the outcomes of all received frames and all outgoing messages.
//
// Two equations always hold modulo 2^32, because every counter wraps around:
//   received = delivered + arp_answered + arp_learned + ping_answered + the sum of drops
//     + fragments.joined
//   failed calls to send_message() and send_to() = the sum of refusals
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::net {

// The reason why a received frame was dropped. If several reasons apply to a frame, only the first
// one is counted.
enum class Drop : std::uint8_t {
  kShort,            // shorter than an Ethernet header
  kNotForUsMac,      // destination is neither our Ethernet address nor broadcast nor our group
  kVlanTagged,       // 802.1Q or 802.1ad tag; the sensor network is untagged
  kNotIpv4OrArp,     // unsupported EtherType, or a length as in 802.3
  kBadIpHeader,      // version, header length or total length inconsistent with the frame
  kBadIpChecksum,    // wrong header checksum
  kFragment,         // unusable fragment, counted in detail by FragmentCounters, or not UDP
  kNotForUsIp,       // destination is neither our address nor a broadcast or group that we receive
  kBadSource,        // source cannot be another host: 0/8, 127/8, 224/3, broadcast, our address
  kNotUdpOrIcmp,     // unsupported IP protocol
  kBadUdpLength,     // UDP length below the header length or beyond the end of the datagram
  kBadUdpChecksum,   // UDP checksum present but wrong
  kBadIcmp,          // ICMP message too short, or its checksum is wrong
  kPingIgnored,      // echo request to a broadcast or not from the peer, or peer unresolved
  kIcmpIgnored,      // ICMP message that is not an echo request
  kBadArp,           // ARP packet too short, or not for Ethernet and IPv4
  kArpIgnored,       // ARP packet that neither requests our address nor contains one that we need
  kAddressConflict,  // another station uses our address in its ARP packet
  kReplyRingFull,    // no transmit buffer for an ARP or ping reply
};
inline constexpr std::size_t kDropCauses = 19;

// The reason why a message was not sent.
enum class Refusal : std::uint8_t {
  kUnresolved,  // the peer's Ethernet address is not known yet
  kRingFull,    // no transmit buffer is free
  kMisuse,      // the payload is longer than kMaxUdpPayloadBytes
};
inline constexpr std::size_t kRefusalCauses = 3;

// The outcomes of fragments. `joined`, `duplicates`, `overlaps`, `bad` and `refused` count frames.
// The other counters count datagrams. Frames counted in `duplicates`, `overlaps`, `bad` or
// `refused` also count towards Drop::kFragment.
struct FragmentCounters {
  std::uint32_t joined = 0;      // stored; the datagram is still incomplete
  std::uint32_t duplicates = 0;  // same bytes at the same offset as an earlier fragment
  std::uint32_t overlaps = 0;    // contradicts an earlier fragment; datagram refused (RFC 5722)
  std::uint32_t bad = 0;         // invalid length or end, so the datagram is refused
  std::uint32_t refused = 0;     // belongs to a refused datagram or comes from an unlisted sender
  std::uint32_t completed = 0;
  std::uint32_t expired = 0;    // incomplete when the timeout expired
  std::uint32_t displaced = 0;  // evicted by a newer datagram
};

struct Counters {
  std::uint32_t received = 0;       // frames received from the port
  std::uint32_t delivered = 0;      // datagrams returned by poll()
  std::uint32_t arp_answered = 0;   // ARP requests for our address that were answered
  std::uint32_t arp_learned = 0;    // other ARP packets with an Ethernet address that we need
  std::uint32_t ping_answered = 0;  // echo requests from the peer that were answered
  std::uint32_t sent = 0;           // messages committed to the port
  std::uint32_t arp_requested = 0;  // ARP requests committed to the port
  std::array<std::uint32_t, kDropCauses> drops{};
  std::array<std::uint32_t, kRefusalCauses> refusals{};
  FragmentCounters fragments{};

  // The names of the counters in the stream (stream/target_table.hpp), in the order of the members.
  // The elements of an array are in the order of the corresponding enumerators.
  static constexpr auto kNames = std::to_array<std::string_view>(
      {"frames received", "datagrams delivered", "ARP answered", "ARP learned", "pings answered",
       "messages sent", "ARP requested",
       // drops
       "short", "not for us (MAC)", "VLAN tagged", "neither IPv4 nor ARP", "bad IP header",
       "bad IP checksum", "fragment", "not for us (IP)", "bad source", "neither UDP nor ICMP",
       "bad UDP length", "bad UDP checksum", "bad ICMP", "ping ignored", "other ICMP", "bad ARP",
       "ARP ignored", "address conflict", "reply without room",
       // refusals
       "peer unresolved", "ring full", "misuse",
       // fragments
       "fragments joined", "fragments duplicate", "fragments overlapping", "fragments bad",
       "fragments refused", "datagrams joined", "datagrams expired", "datagrams displaced"});

  [[nodiscard]] constexpr std::uint32_t& of(Drop cause) {
    return drops[static_cast<std::size_t>(cause)];
  }
  [[nodiscard]] constexpr std::uint32_t of(Drop cause) const {
    return drops[static_cast<std::size_t>(cause)];
  }
  [[nodiscard]] constexpr std::uint32_t& of(Refusal cause) {
    return refusals[static_cast<std::size_t>(cause)];
  }
  [[nodiscard]] constexpr std::uint32_t of(Refusal cause) const {
    return refusals[static_cast<std::size_t>(cause)];
  }
};

static_assert(static_cast<std::size_t>(Drop::kReplyRingFull) + 1 == kDropCauses);
static_assert(static_cast<std::size_t>(Refusal::kMisuse) + 1 == kRefusalCauses);

}  // namespace iog::net
