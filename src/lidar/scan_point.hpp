// Defines the scan point and the packet header for all sensors.
//
// Directions are in the sensor frame: x points forward, y left and z up. The azimuth is
// counter-clockwise from x, as in the vehicle frame (ISO 8855).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::lidar {

// No unit can measure ranges above this limit. Longer ranges can result from x, y and z or from a
// unit's correction, and are clamped to this limit.
inline constexpr std::uint32_t kMaxRangeMm = (std::uint32_t{1} << 20) - 1;

struct ScanPoint {
  std::uint32_t range_mm = 0;       // range along the beam, at most kMaxRangeMm; 0 means no return
  std::uint16_t azimuth_ticks = 0;  // 0 ... ticks_per_turn - 1 of its format
  std::uint8_t layer = 0;           // index of the elevation in the format's list
  std::uint8_t echo = 0;            // 0 for the first echo of its beam, 1 and 2 for later echoes
  bool is_ground : 1 = false;       // classified by the sensor as an echo of the ground
  bool is_dirt : 1 = false;         // classified by the sensor as dirt on its window
  bool is_rain : 1 = false;         // classified by the sensor as rain, snow or clutter
};

// The result of decoding a datagram. Each failure is counted as a drop.
enum class DecodeStatus : std::uint8_t {
  kOk,
  kWrongLength,  // too short for its header, or inconsistent with the length in the header
  kWrongType,    // wrong magic number, data type, block flag or product for this format
  kWrongAngle,   // a tick count, a sector or an azimuth that is invalid for this sensor
  kWrongPoint,   // a point with an invalid layer or echo, or outside its own sector
  kOtherUnit,    // the same layout, but from a different unit of the same manufacturer
};
inline constexpr std::size_t kDecodeStatusCount = 6;

// The azimuths that a packet has swept, counter-clockwise from `first_ticks`. Consecutive packets
// of a scan cover adjacent sectors. Together, the sectors of all packets show whether the scan is
// complete.
struct Sector {
  std::uint16_t first_ticks = 0;  // 0 to ticks_per_turn - 1
  std::uint16_t width_ticks = 0;  // 0 to ticks_per_turn
};

// The period during which a packet was measured, in microseconds on the sensor's own clock. The
// epoch of this clock is 1970-01-01 UTC for a LUX and a Hesai, and the start of the current hour
// for a Velodyne. For an Ouster, the epoch depends on the configuration (with PTP, it is in 1970).
// For a LUX, the times refer to the whole scan, even if the packet contains only a part of the
// scan. For spinning units, the times refer to the packet.
struct Sweep {
  std::uint64_t begin_us = 0;
  std::uint64_t end_us = 0;
  bool turns_right = false;   // clockwise as seen from above
  bool is_of_hour = false;    // the clock counts from the full hour
  bool is_of_packet = false;  // the times refer to the packet, otherwise to the whole scan
};

// The contents of a packet's header, which are available before any point is checked.
struct PacketInfo {
  std::uint64_t fingerprint = 0;  // two packets have the same value only if they are identical
  std::uint32_t scan_number = 0;  // scan counter of the sensor; 0 if the format has none
  std::uint32_t point_count = 0;
  Sector sector;
  Sweep sweep{};
};

}  // namespace iog::lidar
