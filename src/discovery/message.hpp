// A message of SOME/IP service discovery (AUTOSAR PRS_SOMEIPServiceDiscoveryProtocol, "SOME/IP-SD
// Message Format"): big endian, behind a SOME/IP header of service 0xFFFF, event 0x8100.
//
//   16  u8 flags: 0x80 reboot, 0x40 unicast, u24 0
//   20  u32 bytes of the entries, 16 each
//   24  entries:  0  u8 type
//                 1  u8 number of the first option, u8 likewise of the second run of options
//                 3  u4 options of the first run, u4 of the second
//                 4  u16 service, u16 instance, u8 major version, u24 time to live in seconds
//                12  of services: u32 minor version
//                    of event groups: u12 0, u4 counter, u16 event group
//    .  u32 bytes of the options
//    .  options:  0  u16 bytes behind the type, u8 type, u8 0
//                 4  of an IPv4 endpoint: u32 address, u8 0, u8 protocol, u16 port
//
// The wire is hostile: all lengths are checked at once, before an entry is looked at.
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

// A time to live of 0 makes of an offer its withdrawal, of a subscription its end, and of an
// acknowledgement a refusal. The longest has no end.
inline constexpr std::uint32_t kForeverS = 0xFF'FFFF;

// What fits any instance or version of a service that is looked for.
inline constexpr std::uint16_t kAnyInstance = 0xFFFF;
inline constexpr std::uint8_t kAnyMajor = 0xFF;
inline constexpr std::uint32_t kAnyMinor = 0xFFFF'FFFF;

inline constexpr std::size_t kEntryBytes = 16;
inline constexpr std::size_t kEndpointBytes = 12;

enum class EntryType : std::uint8_t { kFind = 0, kOffer = 1, kSubscribe = 6, kSubscribeAck = 7 };

// A number and a count of options.
struct OptionRun {
  std::uint8_t first = 0;
  std::uint8_t count = 0;
};

struct Entry {
  EntryType type = EntryType::kFind;  // or a value that has no name here
  std::array<OptionRun, 2> options{};
  std::uint16_t service = 0;
  std::uint16_t instance = 0;
  std::uint8_t major = 0;
  std::uint32_t ttl_s = 0;  // 24 bits
  std::uint32_t minor = 0;  // of a service
  // Of an event group they stand where a service has its minor version.
  [[nodiscard]] constexpr std::uint16_t event_group() const {
    return static_cast<std::uint16_t>(minor);
  }
};

struct Endpoint {
  net::Ipv4Address address{};
  std::uint16_t port = 0;

  friend constexpr bool operator==(const Endpoint&, const Endpoint&) = default;
};

// A message whose lengths agree. Views of the datagram.
struct Message {
  std::uint16_t session_id = 0;
  std::uint8_t flags = 0;
  std::span<const std::byte> entries{};  // whole ones
  std::span<const std::byte> options{};  // whole ones

  [[nodiscard]] std::size_t entry_count() const { return entries.size() / kEntryBytes; }

  // number < entry_count()
  [[nodiscard]] Entry entry(std::size_t number) const;

  // The one IPv4 endpoint of UDP that the entry refers to; nothing if there is none or another one,
  // or if it refers to options that are not there. Options of other kinds are not looked at.
  [[nodiscard]] std::optional<Endpoint> udp_endpoint_of(const Entry& entry) const;
};

// Nothing if the datagram is no such message, or one whose lengths contradict each other.
[[nodiscard]] std::optional<Message> read_message(std::span<const std::byte> datagram);

// A message with these entries, in which those that refer to an option have the endpoint as theirs.
// Returns its bytes; `buffer` holds message_bytes(entries.size()).
std::size_t write_message(std::uint16_t session_id, std::uint8_t flags,
                          std::span<const Entry> entries, const Endpoint& endpoint,
                          std::span<std::byte> buffer);

[[nodiscard]] constexpr std::size_t message_bytes(std::size_t entries) {
  return protection::kSomeIpHeaderBytes + 12 + entries * kEntryBytes + kEndpointBytes;
}

}  // namespace iog::discovery
