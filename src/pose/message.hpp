// Like all messages, a pose message begins with a SOME/IP header and an E2E header
// (protection/protected_message.hpp). The headers are followed by 72 bytes of big-endian content.
// Each byte is described in docs/spec.md, section 5.1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "pose/fate.hpp"
#include "pose/pose.hpp"
#include "protection/protected_message.hpp"

namespace iog::pose {

inline constexpr std::uint16_t kPosePort = 15010;  // UDP
inline constexpr std::size_t kContentBytes = 72;
inline constexpr std::size_t kMessageBytes = protection::kProtectionBytes + kContentBytes;

// On this channel, each message is checked independently of other messages. The order of messages
// is determined by the sender's clock.
inline constexpr protection::Channel kPoseChannel{
    .event = {.service_id = 0x4F47, .event_id = 0x8003, .interface_version = 1},
    .data_id = 0x494F4703,
    .max_delta_counter = 1};

// Standard deviations from 1 to 65535. The value 65535 means 65535 or more.
struct Sigma {
  std::uint16_t position_mm = 0xFFFF;
  std::uint16_t heading_10urad = 0xFFFF;
  friend constexpr bool operator==(const Sigma&, const Sigma&) = default;
};

// The transform from the local frame to the plane of the map.
struct MapTransform {
  std::uint64_t origin = 0;  // identifies the origin of the map's plane
  Pose local_frame{};
  Sigma sigma{};  // of this transform
  friend constexpr bool operator==(const MapTransform&, const MapTransform&) = default;
};

struct Message {
  std::uint32_t run = 0;       // number of the sender's run; differs from the numbers of earlier
                               // runs
  std::uint32_t age_us = 0;    // from measurement to sending
  std::uint64_t clock_us = 0;  // the sender's clock at the measurement
  Pose pose{};
  Sigma sigma{};                      // of the motion during the second before the message
  std::int32_t speed_mm_per_s = 0;    // along the heading
  std::int32_t yaw_urad_per_s = 0;    // counter-clockwise
  std::optional<MapTransform> map{};  // empty: not known
  friend constexpr bool operator==(const Message&, const Message&) = default;
};

// Encodes and numbers the messages of a sender.
class Encoder {
 public:
  // Returns the complete message. The encoder does not check the fields because the decoder checks
  // them.
  [[nodiscard]] std::array<std::byte, kMessageBytes> encode(const Message& message);

 private:
  protection::Sender sender_{kPoseChannel};
};

struct Decoded {
  Fate fate = Fate::kTooShort;  // kUsed for a valid message, otherwise the reason for its rejection
  Message message{};            // only if the message is valid
};

// Decodes a message. The datagram may contain any bytes. The outcome is kUsed or one of the values
// from kTooShort to kTooOld.
[[nodiscard]] Decoded decode(std::span<const std::byte> datagram);

}  // namespace iog::pose
