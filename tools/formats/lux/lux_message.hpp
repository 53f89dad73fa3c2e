// What a 0x2202 message of an ibeo LUX begins with, and one of its points (docs/spec.md). Neither
// needs a heap, so tests on a board write messages with it, too.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lidar/ibeo_lux.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {

struct LuxPoint {
  std::uint8_t layer = 0;  // 0 ... 3, 0 is the lowest of its side of the mirror
  std::uint8_t echo = 0;   // 0 ... 2
  std::uint8_t flags = 0;
  std::int16_t angle_ticks = 0;  // 1/32 degree, positive to the left
  std::uint16_t range_cm = 0;
  std::uint16_t pulse_width_cm = 0;
  std::uint16_t reserved = 0;

  friend bool operator==(const LuxPoint&, const LuxPoint&) = default;
};

struct LuxHead {
  std::uint8_t device_id = 0;
  std::uint64_t sent_ntp = 0;  // of the message
  std::uint16_t scan_number = 0;
  std::uint16_t status = 0;
  std::uint16_t sync_phase = 0;
  std::uint64_t start_ntp = 0;
  std::uint64_t end_ntp = 0;
  std::uint16_t ticks_per_turn = 11'520;
  std::int16_t start_ticks = 1600;  // where the sweep begins; +50 degrees, the left
  std::int16_t end_ticks = -1600;
  std::array<std::int16_t, 6> mounting{};  // yaw, pitch, roll in ticks; x, y, z in cm
  std::uint16_t flags = 0;
};

// A LUX message must stay below every usual MTU.
inline constexpr std::size_t kMaxLuxDatagramBytes = 1400;

// Of a message with so many points, which follow.
inline void write_lux_head(const LuxHead& head, std::size_t points, wire::ByteWriter& out) {
  using lidar::IbeoLux;
  out.u32_be(IbeoLux::kMagic);
  out.u32_be(0);  // size of the previous message: 0 in live data
  out.u32_be(static_cast<std::uint32_t>(IbeoLux::kScanBytes + IbeoLux::kPointBytes * points));
  out.u8(0);
  out.u8(head.device_id);
  out.u16_be(IbeoLux::kDataType);
  out.u64_be(head.sent_ntp);
  out.u16_le(head.scan_number);
  out.u16_le(head.status);
  out.u16_le(head.sync_phase);
  out.u64_le(head.start_ntp);
  out.u64_le(head.end_ntp);
  out.u16_le(head.ticks_per_turn);
  out.i16_le(head.start_ticks);
  out.i16_le(head.end_ticks);
  out.u16_le(static_cast<std::uint16_t>(points));
  for (const std::int16_t value : head.mounting) {
    out.i16_le(value);
  }
  out.u16_le(head.flags);
}

inline void write_lux_point(const LuxPoint& point, wire::ByteWriter& out) {
  out.u8(static_cast<std::uint8_t>(point.layer | point.echo << 4));
  out.u8(point.flags);
  out.i16_le(point.angle_ticks);
  out.u16_le(point.range_cm);
  out.u16_le(point.pulse_width_cm);
  out.u16_le(point.reserved);
}

}  // namespace iog::tools
