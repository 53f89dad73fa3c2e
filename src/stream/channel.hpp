// The two channels by which a grid is sent. Each has the ids by which automotive tools know its
// messages, and a data id that the CRC covers (docs/spec.md 3.1).
#pragma once

#include <cstddef>
#include <cstdint>

#include "protection/protected_message.hpp"

namespace iog::stream {

// The major version of the format. A receiver refuses any other.
inline constexpr std::uint8_t kInterfaceVersion = 4;
inline constexpr std::uint16_t kServiceId = 0x4F47;  // "OG"

// What is subscribed to by service discovery: all events of the network channel. The minor version
// is that of what may change within a major one: fields that are appended.
inline constexpr std::uint16_t kEventGroup = 0x0001;
inline constexpr std::uint32_t kMinorVersion = 0;

// A receiver is alarmed when more messages than these are missing in a row. A frame of a wide road
// is some 480 messages if its tiles are sent raw, and never more than 1025.
inline constexpr std::uint16_t kMaxDeltaCounter = 512;

constexpr protection::Channel channel_of(std::uint16_t event_id, std::uint32_t data_id) {
  return {.event = {.service_id = kServiceId,
                    .event_id = event_id,
                    .interface_version = kInterfaceVersion},
          .data_id = data_id,
          .max_delta_counter = kMaxDeltaCounter};
}
inline constexpr protection::Channel kNetworkChannel = channel_of(0x8001, 0x494F4701);
inline constexpr protection::Channel kSerialChannel = channel_of(0x8002, 0x494F4702);
// Of a car that has a key: what signs the messages of the first (authentication/stream_signer.hpp).
inline constexpr protection::Channel kSignatureChannel = channel_of(0x8005, 0x494F4705);

}  // namespace iog::stream
