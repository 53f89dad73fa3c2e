// A scan point and the packet that carries it, the same for every lidar.
//
// Directions are those of the sensor frame: x forward, y left, z up; azimuth counter-clockwise from
// x, as in the vehicle frame (ISO 8855).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::lidar {

// No unit sees as far. What a packet and its unit's correction make more of is this.
inline constexpr std::uint32_t kMaxRangeMm = (std::uint32_t{1} << 20) - 1;

struct ScanPoint {
  std::uint32_t range_mm = 0;       // along the beam, 0: no return; at most kMaxRangeMm
  std::uint16_t azimuth_ticks = 0;  // 0 ... ticks_per_turn - 1 of its format
  std::uint8_t layer = 0;           // the elevation's place in the format's list
  std::uint8_t echo = 0;            // 0: the first echo of its beam, 1, 2: later ones
  bool is_ground : 1 = false;       // the sensor says: an echo of the ground
  bool is_dirt : 1 = false;         // the sensor says: dirt on its own window
  bool is_rain : 1 = false;         // the sensor says: rain, snow or clutter
};

// Why a datagram is not a packet of its format. Every cause is a counted drop.
enum class DecodeStatus : std::uint8_t {
  kOk,
  kWrongLength,  // too short for its header, or not as long as its header says
  kWrongType,    // not this format's magic number, data type, block flag or product
  kWrongAngle,   // a tick count, a sector or an azimuth that the sensor cannot have
  kWrongPoint,   // a point of a layer or echo that does not exist, or outside its own sector
  kOtherUnit,    // this layout, but of another unit of the maker's
};
inline constexpr std::size_t kDecodeStatusCount = 6;

// The azimuths that a packet has swept, counter-clockwise from `first_ticks`. The sectors of the
// packets of one scan follow one another; together they say when the scan is complete.
struct Sector {
  std::uint16_t first_ticks = 0;  // 0 ... ticks_per_turn - 1
  std::uint16_t width_ticks = 0;  // 0 ... ticks_per_turn
};

// When a packet was measured, by its sensor's own clock, us. What that clock counts from is its
// format's: for a LUX and a Hesai 1970-01-01 UTC, for an Ouster what the unit is set to, which is
// the same by PTP, for a Velodyne the hour. Of a LUX the times are those of the whole scan, of
// which the packet may be a part; of units that turn those of the packet.
struct Sweep {
  std::uint64_t begin_us = 0;
  std::uint64_t end_us = 0;
  bool turns_right = false;   // clockwise, seen from above
  bool is_of_hour = false;    // the clock counts from the hour
  bool is_of_packet = false;  // not of the whole scan
};

// What a packet says of itself before any of its points is believed.
struct PacketInfo {
  std::uint64_t fingerprint = 0;  // equal for two packets only if they are the same one
  std::uint32_t scan_number = 0;  // the sensor's own, 0 where the format has none
  std::uint32_t point_count = 0;
  Sector sector;
  Sweep sweep{};
};

}  // namespace iog::lidar
