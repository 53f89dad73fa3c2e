// A message of SOME/IP service discovery (AUTOSAR PRS_SOMEIPServiceDiscoveryProtocol, "SOME/IP-SD
// Message Format"). The message is big endian and follows a SOME/IP header with service 0xFFFF and
// event 0x8100.
//
//   16  u8 flags: 0x80 reboot, 0x40 unicast, u24 0
//   20  u32 bytes of the entries, 16 each
//   24  entries:  0  u8 type
//                 1  u8 number of the first option, u8 the same for the second run of options
//                 3  u4 options of the first run, u4 of the second
//                 4  u16 service, u16 instance, u8 major version, u24 time to live in seconds
//                12  for services: u32 minor version
//                    for event groups: u12 0, u4 counter, u16 event group
//    .  u32 bytes of the options
//    .  options:  0  u16 bytes after the type, u8 type, u8 0
//                 4  for an IPv4 endpoint: u32 address, u8 0, u8 protocol, u16 port
//
// The sender is not trusted, so all lengths are checked before any entry is read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "net/address.hpp"
#include "protection/some_ip.hpp"

namespace iog::discovery {

inline constexpr protection::Event kDiscoveryEvent{
    .service_id = 0xFFFF, .event_id = 0x8100, .interface_version = 1};

inline constexpr std::uint8_t kFlagReboot = 0x80;
inline constexpr std::uint8_t kFlagUnicast = 0x40;

// With a time to live of 0, an offer is a stop-offer, a subscription is a request to unsubscribe,
// and an acknowledgement is a refusal. An entry with the maximum time to live never expires.
inline constexpr std::uint32_t kForeverS = 0xFF'FFFF;

// The wildcards for the instance and versions in a find entry.
inline constexpr std::uint16_t kAnyInstance = 0xFFFF;
inline constexpr std::uint8_t kAnyMajor = 0xFF;
inline constexpr std::uint32_t kAnyMinor = 0xFFFF'FFFF;

inline constexpr std::size_t kEntryBytes = 16;
inline constexpr std::size_t kEndpointBytes = 12;

enum class EntryType : std::uint8_t { kFind = 0, kOffer = 1, kSubscribe = 6, kSubscribeAck = 7 };

// A run of consecutive options, given by its first index and its length.
struct OptionRun {
  std::uint8_t first = 0;
  std::uint8_t count = 0;
};

struct Entry {
  EntryType type = EntryType::kFind;  // may contain a value that is not in the enumeration
  std::array<OptionRun, 2> options{};
  std::uint16_t service = 0;
  std::uint16_t instance = 0;
  std::uint8_t major = 0;
  std::uint32_t ttl_s = 0;  // 24-bit value
  std::uint32_t minor = 0;  // minor version, only for services
  // Returns the event group of an event group entry. The event group is stored in the bytes that
  // contain the minor version in a service entry.
  [[nodiscard]] constexpr std::uint16_t event_group() const {
    return static_cast<std::uint16_t>(minor);
  }
};

struct Endpoint {
  net::Ipv4Address address{};
  std::uint16_t port = 0;

  friend constexpr bool operator==(const Endpoint&, const Endpoint&) = default;
};

// A message whose lengths are consistent. The members `entries` and `options` are views of the
// datagram.
struct Message {
  std::uint16_t session_id = 0;
  std::uint8_t flags = 0;
  std::span<const std::byte> entries{};  // complete entries only
  std::span<const std::byte> options{};  // complete options only

  [[nodiscard]] std::size_t entry_count() const { return entries.size() / kEntryBytes; }

  // number < entry_count()
  [[nodiscard]] Entry entry(std::size_t number) const;

  // Returns the IPv4 UDP endpoint that the entry refers to. Returns nothing if the entry refers to
  // no endpoint, to several different endpoints, or to options that do not exist. Options of other
  // kinds are ignored.
  [[nodiscard]] std::optional<Endpoint> udp_endpoint_of(const Entry& entry) const;
};

// Returns nothing if the datagram is not a service discovery message or if its lengths are
// inconsistent.
[[nodiscard]] std::optional<Message> read_message(std::span<const std::byte> datagram);

// Writes a message with these entries. `endpoint` is the only option. Returns the number of bytes
// written. The size of `buffer` must be at least message_bytes(entries.size()).
std::size_t write_message(std::uint16_t session_id, std::uint8_t flags,
                          std::span<const Entry> entries, const Endpoint& endpoint,
                          std::span<std::byte> buffer);

[[nodiscard]] constexpr std::size_t message_bytes(std::size_t entries) {
  return protection::kSomeIpHeaderBytes + 12 + entries * kEntryBytes + kEndpointBytes;
}

}  // namespace iog::discovery
