// One scan of an ibeo LUX as 0x2202 messages carry it (docs/spec.md), and its way to the wire: a
// scan that is too long for a datagram is split into several messages of the same scan number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lidar/formats.hpp"

namespace iog::tools {

// Bits of LuxPoint::flags.
inline constexpr std::uint8_t kLuxRain = 0x02;
inline constexpr std::uint8_t kLuxGround = 0x04;
inline constexpr std::uint8_t kLuxDirt = 0x08;

// Units of four layers and of eight send the same messages.
[[nodiscard]] constexpr bool sends_lux_scans(lidar::Format format) {
  return format == lidar::kFormat<lidar::IbeoLux> || format == lidar::kFormat<lidar::IbeoLux8>;
}

// The mirror has two sides, which scan in turns: the scans with odd numbers are the rear's, as in
// recordings of LUX.
enum class MirrorSide : std::uint8_t { kFront, kRear };
[[nodiscard]] constexpr MirrorSide side_of_scan(std::uint32_t number) {
  return number % 2 == 0 ? MirrorSide::kFront : MirrorSide::kRear;
}

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

struct LuxScan {
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
  std::vector<LuxPoint> points;
};

// A LUX message must stay below every usual MTU.
inline constexpr std::size_t kMaxLuxDatagramBytes = 1400;

// A whole message, header and body, as IbeoLux accepts it. UsageError if it contradicts itself.
[[nodiscard]] LuxScan parse_lux_message(std::span<const std::byte> message);

// Splits a scan into messages of at most max_bytes, each with at least one point. Points are
// sorted, stably, into the order of the sweep. The start and end angle of a message are the sector
// that it covers; the sectors follow one another from the scan's start to its end. Points of one
// azimuth stay together unless they alone are longer than a message. An azimuth on a border belongs
// to the message that the sweep reaches first.
[[nodiscard]] std::vector<std::vector<std::byte>> split_lux_scan(
    LuxScan scan, std::size_t max_bytes = kMaxLuxDatagramBytes);

}  // namespace iog::tools
