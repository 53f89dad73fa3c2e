// One scan of an ibeo LUX as 0x2202 messages carry it (docs/spec.md), and its way to the wire: a
// scan that is too long for a datagram is split into several messages of the same scan number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lidar/formats.hpp"
#include "tools/formats/lux/lux_message.hpp"

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

struct LuxScan : LuxHead {
  std::vector<LuxPoint> points;
};

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
