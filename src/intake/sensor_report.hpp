// What is said of sensors and their packets. The values are on the wire (docs/spec.md).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::intake {

// Why a datagram was dropped before any of its points was seen.
enum class PacketDrop : std::uint8_t {
  kStranger,  // no sensor of this vehicle sends from there to this port
  kWrongLength,
  kWrongType,
  kWrongAngle,
  kWrongPoint,
  kDuplicate,   // this very packet was fused before
  kLate,        // of a scan whose frame is closed
  kOverBudget,  // more points than the sensor's description allows in one scan
  kOtherUnit,   // of another unit of the same maker's, or it is not known of which of two
  kNotTaken,    // it has waited too long, because the target is too slow
  kFrozen,      // new by its stamp, but its ranges are those of a packet before
  kTooSoon,     // of a scan that begins sooner after the one before than any unit scans
};
inline constexpr std::size_t kPacketDropCount = 12;

enum class SensorState : std::uint8_t {
  kNeverSeen,  // since start
  kSilent,     // nothing in this frame
  kPartial,    // some packets of its scan
  kComplete,   // its whole scan
};

// Where nearly nothing comes back to it (intake/blocked_sectors.hpp).
enum class Blocked : std::uint8_t { kNot, kPartly, kWhole };

struct SensorReport {
  SensorState state = SensorState::kNeverSeen;
  Blocked blocked = Blocked::kNot;
  std::uint16_t age_frames = 0xFFFF;  // frames since it last took part, 0xFFFF: never or longer
  std::uint16_t packets = 0;          // fused in this frame
  std::uint32_t points = 0;           // in those packets
  std::uint32_t scan_number = 0;      // of its last scan
};

}  // namespace iog::intake
