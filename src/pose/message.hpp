// A pose message: SOME/IP and E2E headers as around every message
// (protection/protected_message.hpp), then 72 bytes of content, big endian, byte by byte in
// docs/spec.md, section 5.1.
//
// Sender and target share this file: what one writes the other reads.
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

// Only the checks of the whole message are of use: which message is the newest, its clock says.
inline constexpr protection::Channel kPoseChannel{
    .event = {.service_id = 0x4F47, .event_id = 0x8003, .interface_version = 1},
    .data_id = 0x494F4703,
    .max_delta_counter = 1};

// Standard deviations, 1 ... 65535; the largest stands for anything above it.
struct Sigma {
  std::uint16_t position_mm = 0xFFFF;
  std::uint16_t heading_10urad = 0xFFFF;
  friend constexpr bool operator==(const Sigma&, const Sigma&) = default;
};

// Where the local frame is in the map's plane.
struct MapTransform {
  std::uint64_t origin = 0;  // names the origin of the map's plane
  Pose local_frame{};
  Sigma sigma{};  // of this transform
  friend constexpr bool operator==(const MapTransform&, const MapTransform&) = default;
};

struct Message {
  std::uint32_t run = 0;       // of the sender; differs from that of its earlier runs
  std::uint32_t age_us = 0;    // from the measurement to the sending
  std::uint64_t clock_us = 0;  // the sender's clock at the measurement
  Pose pose{};
  Sigma sigma{};                      // of the motion during the second before the message
  std::int32_t speed_mm_per_s = 0;    // along the heading
  std::int32_t yaw_urad_per_s = 0;    // counter-clockwise
  std::optional<MapTransform> map{};  // empty: not known
  friend constexpr bool operator==(const Message&, const Message&) = default;
};

// Numbers a sender's messages from their first.
class Encoder {
 public:
  // The whole message. Fields are written as they are; the decoder judges them.
  [[nodiscard]] std::array<std::byte, kMessageBytes> encode(const Message& message);

 private:
  protection::Sender sender_{kPoseChannel};
};

struct Decoded {
  Fate fate = Fate::kTooShort;  // kUsed: a sound message, else why it is not one
  Message message{};            // of a sound message alone
};

// Any bytes may come. kUsed, kTooShort ... kTooOld.
[[nodiscard]] Decoded decode(std::span<const std::byte> datagram);

}  // namespace iog::pose
