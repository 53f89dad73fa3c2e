// The SOME/IP header of an event notification (AUTOSAR PRS_SOMEIPProtocol, section "Header"). The
// header is 16 bytes long and big-endian.
//
//    0  u16 service id, u16 event id (highest bit set)     together the message id
//    4  u32 length: bytes after this field, including 8 of this header
//    8  u16 client id 0, u16 session id                    together the request id
//   12  u8 protocol version 1
//   13  u8 interface version: major version of the service
//   14  u8 message type: 0x02 notification
//   15  u8 return code: 0
//
// A sender numbers its notifications with session IDs from 1 to 0xFFFF, and then starts again at 1.
// A session ID of 0 would mean that the sender does not use session handling.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::protection {

inline constexpr std::size_t kSomeIpHeaderBytes = 16;
inline constexpr std::size_t kSomeIpLengthOffset = 8;  // offset of the first byte that it counts

// Identifies the notifications of one event. The highest bit of `event_id` is set.
struct Event {
  std::uint16_t service_id;
  std::uint16_t event_id;
  std::uint8_t interface_version;

  friend bool operator==(const Event&, const Event&) = default;
};

enum class SomeIpStatus : std::uint8_t {
  kOk,
  kTooShort,      // shorter than a header or than its length field
  kTooLong,       // longer than its length field; we send one message per datagram
  kNotOurs,       // wrong protocol version, service or event
  kWrongVersion,  // wrong interface version; see interface_version_of()
  kWrongType,     // not a notification, or its return code is an error
};

// Writes the header of a complete message. Requires message.size() >= 16.
void write_some_ip_header(const Event& event, std::uint16_t session_id,
                          std::span<std::byte> message);

// Checks that the datagram contains exactly one message of this event.
[[nodiscard]] SomeIpStatus check_some_ip_header(const Event& event,
                                                std::span<const std::byte> datagram);

// Returns the interface version in the SOME/IP header of a datagram. Returns 0 if the datagram is
// too short.
[[nodiscard]] std::uint8_t interface_version_of(std::span<const std::byte> datagram);

[[nodiscard]] constexpr std::uint16_t session_after(std::uint16_t session_id) {
  return session_id == 0xFFFF ? std::uint16_t{1} : static_cast<std::uint16_t>(session_id + 1);
}

}  // namespace iog::protection
