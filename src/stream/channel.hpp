// Defines the channels that transport a grid. Each channel has the service and event IDs that
// automotive tools expect, and a data ID that the CRC covers (docs/spec.md 3.1).
#pragma once

#include <cstdint>

#include "protection/protected_message.hpp"

namespace iog::stream {

// The major version of the format. Receivers reject all other versions.
inline constexpr std::uint8_t kInterfaceVersion = 5;
inline constexpr std::uint16_t kServiceId = 0x4F47;  // "OG"

// The event group that service discovery offers. The group contains all events of the network
// channel. If fields are appended, only the minor version increases.
inline constexpr std::uint16_t kEventGroup = 0x0001;
inline constexpr std::uint32_t kMinorVersion = 0;

// A receiver reports an error if more than kMaxDeltaCounter consecutive messages are missing. If
// all tiles are sent raw, a frame takes about 480 messages on a wide road. No frame needs more than
// 1025 messages.
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
// The channel for the signatures of the network channel's messages. This channel is used only if
// the car has a key (authentication/stream_signer.hpp).
inline constexpr protection::Channel kSignatureChannel = channel_of(0x8005, 0x494F4705);

}  // namespace iog::stream
