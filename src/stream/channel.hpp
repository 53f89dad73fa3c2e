// The channels that carry a grid. Each has the service and event ids of automotive tools, and a
// data id that its CRC covers (docs/spec.md 3.1).
#pragma once

#include <cstddef>
#include <cstdint>

#include "protection/protected_message.hpp"

namespace iog::stream {

// The major version of the format. Receivers refuse any other.
inline constexpr std::uint8_t kInterfaceVersion = 4;
inline constexpr std::uint16_t kServiceId = 0x4F47;  // "OG"

// The event group that service discovery offers: all events of the network channel. The minor
// version increases when fields are appended within a major version.
inline constexpr std::uint16_t kEventGroup = 0x0001;
inline constexpr std::uint32_t kMinorVersion = 0;

// A receiver reports an error when more messages than these are missing in a row. A frame of a wide
// road takes some 480 messages if its tiles are sent raw, and never more than 1025.
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
// For cars with a key: signs the messages of the network channel
// (authentication/stream_signer.hpp).
inline constexpr protection::Channel kSignatureChannel = channel_of(0x8005, 0x494F4705);

}  // namespace iog::stream
