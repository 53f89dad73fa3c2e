#include "lidar/mavlink_ultrasonic.hpp"

#include <algorithm>

#include "lidar/fingerprint.hpp"
#include "wire/byte_order.hpp"
#include "wire/byte_reader.hpp"

namespace iog::lidar {
namespace {

constexpr std::uint8_t kMavlink2 = 0xFD;
constexpr std::uint32_t kDistanceSensor = 132;
constexpr std::uint8_t kUltrasound = 1;
constexpr std::uint8_t kInvalidSignal = 1;
constexpr std::uint32_t kMillimetresPerCentimetre = 10;

// Hash of the names and types of the message's fields. It makes other layouts fail the checksum.
constexpr std::byte kLayout{85};

// CRC-16/MCRF4XX: reflected polynomial 0x1021, initial value all ones. MAVLink calls it X.25.
constexpr std::uint16_t next_checksum(std::uint16_t state, std::byte byte) {
  state = static_cast<std::uint16_t>(state ^ std::to_integer<std::uint16_t>(byte));
  for (int bit = 0; bit < 8; ++bit) {
    state = static_cast<std::uint16_t>((state >> 1) ^ ((state & 1U) != 0 ? 0x8408U : 0U));
  }
  return state;
}

// MAV_SENSOR_ORIENTATION: upright in steps of 45 degrees, and backwards, which has a value of its
// own. The mount in the car file decides where the unit looks.
constexpr bool looks_aside(std::uint8_t orientation) {
  return orientation <= 7 || orientation == 12;
}

struct Head {
  explicit Head(std::span<const std::byte> datagram) {
    wire::ByteReader in(datagram);
    magic = in.u8();
    payload_bytes = in.u8();
    flags_that_count = in.u8();
    in.skip(4);  // optional flags, sequence number, system and component of the sender
    message = in.u8();
    message += std::uint32_t{in.u16_le()} << 8;
    is_whole = in.ok();
  }

  std::uint8_t magic;
  std::uint8_t payload_bytes;
  std::uint8_t flags_that_count;
  std::uint32_t message;
  bool is_whole;
};

}  // namespace

// The first byte is not part of the checksum.
std::uint16_t MavlinkUltrasonic::checksum_of(std::span<const std::byte> message) {
  std::uint16_t state = 0xFFFF;
  for (const std::byte byte : message.subspan(1)) {
    state = next_checksum(state, byte);
  }
  return next_checksum(state, kLayout);
}

DecodeStatus MavlinkUltrasonic::decode(std::span<const std::byte> datagram) {
  *this = MavlinkUltrasonic{};
  const Head head(datagram);
  if (head.is_whole &&
      (head.magic != kMavlink2 || head.flags_that_count != 0 || head.message != kDistanceSensor)) {
    return DecodeStatus::kWrongType;
  }
  if (!head.is_whole || head.payload_bytes > kMostPayloadBytes ||
      datagram.size() != kHeadBytes + head.payload_bytes + kChecksumBytes) {
    return DecodeStatus::kWrongLength;
  }
  const auto message = datagram.first(kHeadBytes + head.payload_bytes);
  if (checksum_of(message) != wire::load_le16(datagram.last<kChecksumBytes>())) {
    return DecodeStatus::kWrongType;
  }

  std::array<std::byte, kMostPayloadBytes> payload{};
  std::ranges::copy(message.subspan(kHeadBytes), payload.begin());
  wire::ByteReader in(payload);
  const std::uint32_t time_ms = in.u32_le();
  const std::uint16_t least_cm = in.u16_le();
  const std::uint16_t most_cm = in.u16_le();
  distance_cm_ = in.u16_le();
  const std::uint8_t kind = in.u8();
  in.skip(1);  // the unit's number
  const std::uint8_t orientation = in.u8();
  in.skip(1 + 4 + 4 + 16);  // variance, two fields of view, a rotation
  const std::uint8_t quality = in.u8();
  if (kind != kUltrasound) {
    return DecodeStatus::kWrongType;
  }
  if (!looks_aside(orientation)) {
    return DecodeStatus::kWrongAngle;
  }

  constexpr std::uint32_t kNumberMs = 8;  // shorter than the shortest scan of any unit, 10 ms
  constexpr std::uint16_t kWidth = kDataSheet.scan_width_ticks;
  const std::uint64_t time_us = std::uint64_t{time_ms} * 1000;
  info_ = {.fingerprint = fingerprint(datagram),
           .scan_number = time_ms / kNumberMs,
           .point_count = 1,
           .sector = {.first_ticks = kTicksPerTurn - kWidth / 2, .width_ticks = kWidth},
           .sweep = {.begin_us = time_us, .end_us = time_us, .is_of_packet = true}};
  point_ = {.range_mm = distance_cm_ >= most_cm ? 0 : distance_cm_ * kMillimetresPerCentimetre,
            .is_rain = quality == kInvalidSignal || distance_cm_ < least_cm};
  return DecodeStatus::kOk;
}

}  // namespace iog::lidar
