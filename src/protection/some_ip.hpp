// The SOME/IP header of an event notification (AUTOSAR PRS_SOMEIPProtocol, section "Header"):
// big endian, 16 bytes.
//
//    0  u16 service id, u16 event id (highest bit set)     together the message id
//    4  u32 length: bytes behind this field, 8 of header included
//    8  u16 client id 0, u16 session id                    together the request id
//   12  u8 protocol version 1
//   13  u8 interface version: major version of the service
//   14  u8 message type: 0x02 notification
//   15  u8 return code: 0
//
// A sender counts its notifications by session ids 1 to 0xFFFF and wraps to 1: 0 would mean that
// sessions are not counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::protection {

inline constexpr std::size_t kSomeIpHeaderBytes = 16;
inline constexpr std::size_t kSomeIpLengthOffset = 8;  // where the bytes of the field length begin

// Which notifications these are. `event_id` has its highest bit set.
struct Event {
  std::uint16_t service_id;
  std::uint16_t event_id;
  std::uint8_t interface_version;

  friend bool operator==(const Event&, const Event&) = default;
};

enum class SomeIpStatus : std::uint8_t {
  kOk,
  kTooShort,  // for a header, or than its length says
  kTooLong,   // than its length says: SOME/IP may put several messages into one datagram, we do not
  kNotOurs,   // another version of the protocol, another service or event
  kWrongVersion,  // of the interface; interface_version_of() says which
  kWrongType,     // not a notification, or one with an error as return code
};

// Fills in the header of a whole message, `message` >= 16 bytes.
void write_some_ip_header(const Event& event, std::uint16_t session_id,
                          std::span<std::byte> message);

// Whether the datagram is one message of this event.
[[nodiscard]] SomeIpStatus check_some_ip_header(const Event& event,
                                                std::span<const std::byte> datagram);

// What a datagram with such a header says; 0 if it is too short for it.
[[nodiscard]] std::uint8_t interface_version_of(std::span<const std::byte> datagram);

[[nodiscard]] constexpr std::uint16_t session_after(std::uint16_t session_id) {
  return session_id == 0xFFFF ? std::uint16_t{1} : static_cast<std::uint16_t>(session_id + 1);
}

}  // namespace iog::protection
