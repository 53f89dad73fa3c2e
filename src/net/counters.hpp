// What became of every frame that arrived and of every message that was to be sent.
//
// Two laws hold at any moment, modulo 2^32 (every counter wraps):
//   received = delivered + arp_answered + arp_learned + ping_answered + the sum of drops
//     + fragments.joined
//   calls of send_message() that failed = the sum of refusals
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::net {

// Why a received frame was dropped. Each frame counts under the first cause that applies.
enum class Drop : std::uint8_t {
  kShort,            // less than an Ethernet header
  kNotForUsMac,      // destination neither our Ethernet address nor broadcast nor our group
  kVlanTagged,       // 802.1Q or 802.1ad tag; the sensors' network is untagged
  kNotIpv4OrArp,     // another EtherType, or an 802.3 length
  kBadIpHeader,      // version, header length or total length contradict the frame
  kBadIpChecksum,    // header checksum wrong
  kFragment,         // part of a datagram, and of no use (Reassembly says why, or it is not of UDP)
  kNotForUsIp,       // destination neither our address nor a broadcast or group that reaches us
  kBadSource,        // source that no other host can have: 0/8, 127/8, 224/3, broadcast, our own
  kNotUdpOrIcmp,     // another protocol
  kBadUdpLength,     // UDP length less than its header or more than the datagram
  kBadUdpChecksum,   // UDP checksum present and wrong
  kBadIcmp,          // ICMP message too short or checksum wrong
  kPingIgnored,      // echo request from another than the peer, to a broadcast, or peer unresolved
  kIcmpIgnored,      // ICMP message that is not an echo request
  kBadArp,           // ARP packet short, or not for Ethernet and IPv4
  kArpIgnored,       // ARP packet that neither asks for us nor tells what we want to know
  kAddressConflict,  // another station claims our address in its ARP packet
  kReplyRingFull,    // an ARP or ping reply was due, but the transmit ring was full
};
inline constexpr std::size_t kDropCauses = 19;

// Why a message was not sent.
enum class Refusal : std::uint8_t {
  kUnresolved,  // the peer's Ethernet address is not known yet
  kRingFull,    // no transmit buffer is free
  kMisuse,      // the payload is longer than kMaxUdpPayloadBytes
};
inline constexpr std::size_t kRefusalCauses = 3;

// What became of fragments. joined, duplicates, overlaps, bad and refused count frames, the others
// datagrams. duplicates, overlaps, bad and refused are among the frames dropped as kFragment.
struct FragmentCounters {
  std::uint32_t joined = 0;  // taken into a datagram; the one that completes it is not among them
  std::uint32_t duplicates = 0;  // say again what is there
  std::uint32_t overlaps = 0;    // say otherwise: their datagram is given up (RFC 5722)
  std::uint32_t bad = 0;         // a length or an end that cannot be: likewise
  std::uint32_t refused = 0;     // of a datagram that has been given up, or of a stranger
  std::uint32_t completed = 0;
  std::uint32_t expired = 0;    // not complete in time
  std::uint32_t displaced = 0;  // by a newer one of the same sender
};

struct Counters {
  std::uint32_t received = 0;       // frames taken from the port
  std::uint32_t delivered = 0;      // datagrams returned by poll()
  std::uint32_t arp_answered = 0;   // requests for our address answered
  std::uint32_t arp_learned = 0;    // others that told the Ethernet address of peer or neighbour
  std::uint32_t ping_answered = 0;  // echo requests of the peer answered
  std::uint32_t sent = 0;           // messages committed to the port
  std::uint32_t arp_requested = 0;  // ARP requests committed to the port
  std::array<std::uint32_t, kDropCauses> drops{};
  std::array<std::uint32_t, kRefusalCauses> refusals{};
  FragmentCounters fragments{};

  // In the stream (stream/target_table.hpp), in the order of the members and their enumerators.
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
