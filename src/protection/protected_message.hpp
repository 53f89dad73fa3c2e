// A message on the wire. The message consists of a SOME/IP header, an E2E header and content.
//
//    0  SOME/IP header, 16 bytes (protection/some_ip.hpp)
//   16  E2E Profile 4 header, 12 bytes (protection/profile4.hpp)
//   28  content
//
// AUTOSAR combines the two headers in this way. According to PRS_SOMEIPProtocol, the E2E header has
// an offset of 64 bits, directly after the return code. PRS_E2EProtocol contains an example with
// this offset. Protection starts after the length field of the SOME/IP header. The CRC covers bytes
// 8 to 23 and the content from byte 28. Bytes 8 to 23 are the request ID, versions, message type,
// return code, E2E length, counter and data ID. The CRC does not cover bytes 0 to 7, which are the
// message ID and the SOME/IP length. These bytes are protected indirectly: the message ID by the
// data ID, and the SOME/IP length by the E2E length, which counts the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protection/profile4.hpp"
#include "protection/some_ip.hpp"

namespace iog::protection {

inline constexpr std::size_t kProtectionBytes = kSomeIpHeaderBytes + kProfile4HeaderBytes;

// The maximum length of a complete message. SOME/IP segmentation (TP) puts at most 1392 bytes of
// payload into one datagram. Even if the E2E header is counted as payload, as automotive tools do,
// our payload is shorter.
inline constexpr std::size_t kMaxMessageBytes = 1392;
inline constexpr std::size_t kMaxContentBytes = kMaxMessageBytes - kProtectionBytes;

struct Channel {
  Event event;
  std::uint32_t data_id;
  std::uint16_t max_delta_counter;  // the maximum counter step that raises no alarm

  [[nodiscard]] constexpr Profile4 profile() const {
    return {.data_id = data_id,
            .offset_bytes = kSomeIpHeaderBytes - kSomeIpLengthOffset,
            .max_delta_counter = max_delta_counter};
  }
};

class Sender {
 public:
  constexpr explicit Sender(const Channel& channel)
      : event_{channel.event}, protector_{channel.profile()} {}

  // Fills in both headers. The content must already be in place after the headers. The tail, if
  // there is one, is part of the content. Requires kProtectionBytes <= message.size() <=
  // kMaxMessageBytes.
  void protect(std::span<std::byte> message, TailRemainder tail = {});

 private:
  Event event_;
  Profile4Protector protector_;
  std::uint16_t session_id_ = 1;
};

struct Received {
  SomeIpStatus header = SomeIpStatus::kTooShort;  // unless kOk, only the interface version is valid
  std::uint8_t interface_version = 0;             // the sender's version, set for kWrongVersion
  CheckStatus check = CheckStatus::kError;
  std::uint16_t delta_counter = 0;       // counter step from the previous message; 0 after an error
  std::span<const std::byte> content{};  // empty unless the message is valid
};

class Receiver {
 public:
  constexpr explicit Receiver(const Channel& channel)
      : event_{channel.event}, checker_{channel.profile()} {}

  // Processes a datagram, which may contain any bytes. If the datagram's header does not belong to
  // this channel, the state does not change.
  [[nodiscard]] Received receive(std::span<const std::byte> datagram);

 private:
  Event event_;
  Profile4Checker checker_;
};

}  // namespace iog::protection
