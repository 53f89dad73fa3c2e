#include "pose/message.hpp"

#include "pose/limits.hpp"
#include "pose/wire_format.hpp"
#include "protection/believed.hpp"

namespace iog::pose {
namespace {

constexpr std::uint8_t kContentVersion = 1;
constexpr std::uint8_t kFlagMap = 0x01;

constexpr bool is_within(std::int32_t value, std::int32_t most) {
  return value >= -most && value <= most;
}

constexpr bool is_within(const Pose& pose) {
  return is_within(pose.x_mm, kMaxCoordinateMm) && is_within(pose.y_mm, kMaxCoordinateMm);
}

constexpr bool has_sigma(const Sigma& sigma) {
  return sigma.position_mm != 0 && sigma.heading_10urad != 0;
}

// Checks the values of the fields, in the order of docs/spec.md.
Fate fate_of(const Message& message) {
  const bool has_map = message.map.has_value();
  if (message.clock_us > kMaxClockUs || !is_within(message.pose) ||
      (has_map && !is_within(message.map->local_frame)) ||
      !is_within(message.speed_mm_per_s, kMaxSpeedMmPerS) ||
      !is_within(message.yaw_urad_per_s, kMaxYawRateUradPerS)) {
    return Fate::kOutOfRange;
  }
  if (!has_sigma(message.sigma) || (has_map && !has_sigma(message.map->sigma))) {
    return Fate::kNoSigma;
  }
  return message.age_us > kMaxAgeUs ? Fate::kTooOld : Fate::kUsed;
}

Decoded decode_content(std::span<const std::byte> content) {
  wire::ByteReader in(content);
  const std::uint8_t version = in.u8();
  const std::uint8_t flags = in.u8();
  const std::uint16_t header_bytes = in.u16_be();
  if (version != kContentVersion) {
    return {.fate = Fate::kWrongVersion};
  }
  if (header_bytes != content.size()) {
    return {.fate = Fate::kWrongLength};
  }
  Message message;
  message.run = in.u32_be();
  message.age_us = in.u32_be();
  message.clock_us = in.u64_be();
  message.pose = read_pose(in);
  message.sigma = read_sigma(in);
  message.speed_mm_per_s = in.i32_be();
  message.yaw_urad_per_s = in.i32_be();
  const MapTransform map = read_map_transform(in);
  const std::uint32_t reserved = in.u32_be();
  if ((flags & ~kFlagMap) != 0) {
    return {.fate = Fate::kWrongFlags};
  }
  const bool has_map = (flags & kFlagMap) != 0;
  if (reserved != 0 || (!has_map && map != kNoMap)) {
    return {.fate = Fate::kNotZero};
  }
  if (has_map) {
    message.map = map;
  }
  return {.fate = fate_of(message), .message = message};
}

}  // namespace

std::array<std::byte, kMessageBytes> Encoder::encode(const Message& message) {
  std::array<std::byte, kMessageBytes> bytes{};
  const std::span content = std::span(bytes).subspan<protection::kProtectionBytes>();
  wire::ByteWriter out(content);
  out.u8(kContentVersion);
  out.u8(message.map ? kFlagMap : std::uint8_t{0});
  out.u16_be(kContentBytes);
  out.u32_be(message.run);
  out.u32_be(message.age_us);
  out.u64_be(message.clock_us);
  write(message.pose, out);
  write(message.sigma, out);
  out.i32_be(message.speed_mm_per_s);
  out.i32_be(message.yaw_urad_per_s);
  write(message.map, out);
  out.u32_be(0);
  sender_.protect(bytes);
  return bytes;
}

Decoded decode(std::span<const std::byte> datagram) {
  if (datagram.size() < kMessageBytes) {
    return {.fate = Fate::kTooShort};
  }
  const protection::Received received = protection::Receiver(kPoseChannel).receive(datagram);
  if (const Fate fate = protection::fate_of(received, Fate::kUsed); fate != Fate::kUsed) {
    return {.fate = fate};
  }
  return decode_content(received.content);
}

}  // namespace iog::pose
