// A scan point and the header of its packet, common to all sensors.
//
// Directions are in the sensor frame: x forward, y left, z up; azimuth counter-clockwise from x, as
// in the vehicle frame (ISO 8855).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::lidar {

// A range that no unit reaches. Longer ranges, from a packet or from its unit's correction, are
// limited to it.
inline constexpr std::uint32_t kMaxRangeMm = (std::uint32_t{1} << 20) - 1;

struct ScanPoint {
  std::uint32_t range_mm = 0;       // along the beam, 0: no return; at most kMaxRangeMm
  std::uint16_t azimuth_ticks = 0;  // 0 ... ticks_per_turn - 1 of its format
  std::uint8_t layer = 0;           // index of the elevation in the format's list
  std::uint8_t echo = 0;            // 0: the first echo of its beam, 1, 2: later ones
  bool is_ground : 1 = false;       // the sensor says: an echo of the ground
  bool is_dirt : 1 = false;         // the sensor says: dirt on its own window
  bool is_rain : 1 = false;         // the sensor says: rain, snow or clutter
};

// Why a datagram is not a packet of its format. Each cause is counted as a drop.
enum class DecodeStatus : std::uint8_t {
  kOk,
  kWrongLength,  // too short for its header, or not as long as its header says
  kWrongType,    // not this format's magic number, data type, block flag or product
  kWrongAngle,   // a tick count, a sector or an azimuth that the sensor cannot have
  kWrongPoint,   // a point of a layer or echo that does not exist, or outside its own sector
  kOtherUnit,    // this layout, but from another unit of the same maker
};
inline constexpr std::size_t kDecodeStatusCount = 6;

// The azimuths that a packet has swept, counter-clockwise from `first_ticks`. The sectors of the
// packets of one scan follow one another; together they show when the scan is complete.
struct Sector {
  std::uint16_t first_ticks = 0;  // 0 ... ticks_per_turn - 1
  std::uint16_t width_ticks = 0;  // 0 ... ticks_per_turn
};

// When a packet was measured, in microseconds of its sensor's own clock. The format decides where
// that clock starts: for a LUX and a Hesai at 1970-01-01 UTC, for a Velodyne at the hour, and for
// an Ouster as the unit is set up (with PTP also 1970). For a LUX the times are those of the whole
// scan, even if the packet is only a part of it. For spinning units they are those of the packet.
struct Sweep {
  std::uint64_t begin_us = 0;
  std::uint64_t end_us = 0;
  bool turns_right = false;   // clockwise, seen from above
  bool is_of_hour = false;    // the clock counts from the hour
  bool is_of_packet = false;  // otherwise of the whole scan
};

// What the header of a packet says, before any of its points is checked.
struct PacketInfo {
  std::uint64_t fingerprint = 0;  // two packets have the same one only if they are the same packet
  std::uint32_t scan_number = 0;  // counted by the sensor; 0 if the format has none
  std::uint32_t point_count = 0;
  Sector sector;
  Sweep sweep{};
};

}  // namespace iog::lidar
