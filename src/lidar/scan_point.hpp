// A scan point and the packet that carries it, the same for every lidar.
//
// Directions are those of the sensor frame: x forward, y left, z up; azimuth counter-clockwise from
// x, as in the vehicle frame (ISO 8855).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::lidar {

// The wire formats that are understood (docs/spec.md).
enum class Format : std::uint8_t {
  kIbeoLux,        // 0x2202 messages
  kVelodyneVlp16,  // data packets of 1206 bytes
};

struct ScanPoint {
  std::uint32_t range_mm = 0;       // along the beam, 0: no return
  std::uint16_t azimuth_ticks = 0;  // 0 ... ticks_per_turn - 1 of its format
  std::uint8_t layer = 0;           // the elevation's place in the format's list
  std::uint8_t echo = 0;            // 0: the first echo of its beam, 1, 2: later ones
  bool is_ground = false;           // the sensor says: an echo of the ground
  bool is_dirt = false;             // the sensor says: dirt on its own window
  bool is_rain = false;             // the sensor says: rain, snow or clutter
};

// Why a datagram is not a packet of its format. Every cause is a counted drop.
enum class DecodeStatus : std::uint8_t {
  kOk,
  kWrongLength,  // too short for its header, or not as long as its header says
  kWrongType,    // not this format's magic number, data type, block flag or product
  kWrongAngle,   // a tick count, a sector or an azimuth that the sensor cannot have
  kWrongPoint,   // a point of a layer or echo that does not exist, or outside its own sector
};
inline constexpr std::size_t kDecodeStatusCount = 5;

// The azimuths that a packet has swept, counter-clockwise from `first_ticks`. The sectors of the
// packets of one scan follow one another; together they say when the scan is complete.
struct Sector {
  std::uint16_t first_ticks = 0;  // 0 ... ticks_per_turn - 1
  std::uint16_t width_ticks = 0;  // 0 ... ticks_per_turn
};

// What a packet says of itself before any of its points is believed.
struct PacketInfo {
  std::uint64_t fingerprint = 0;  // equal for two packets only if they are the same one
  std::uint32_t scan_number = 0;  // the sensor's own, 0 where the format has none
  std::uint32_t point_count = 0;
  Sector sector;
};

}  // namespace iog::lidar
