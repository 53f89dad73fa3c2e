// Defines the types used to report on sensors and their packets. The values are used on the wire
// (docs/spec.md).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::intake {

// The reason why a datagram was dropped before any of its points were used.
enum class PacketDrop : std::uint8_t {
  kStranger,  // no sensor of this vehicle may send from this source to this port
  kWrongLength,
  kWrongType,
  kWrongAngle,
  kWrongPoint,
  kDuplicate,   // the same packet has already been fused
  kLate,        // the frame of its scan has been closed
  kOverBudget,  // more points than the car file allows in one scan
  kOtherUnit,   // from a different unit of the same make, or from one of two identical units
  kNotTaken,    // shed after waiting too long because the target is too slow
  kFrozen,      // has a new timestamp but repeats the ranges of an earlier packet
  kTooSoon,     // its scan begins too soon after the last scan for any unit
};
inline constexpr std::size_t kPacketDropCount = 12;

enum class SensorState : std::uint8_t {
  kNeverSeen,  // no packet since start
  kSilent,     // no packet in this frame
  kPartial,    // some packets of its scan
  kComplete,   // all packets of its scan
};

// Whether a sensor is blocked in none, some or all of its sectors (intake/blocked_sectors.hpp).
enum class Blocked : std::uint8_t { kNot, kPartly, kWhole };

struct SensorReport {
  SensorState state = SensorState::kNeverSeen;
  Blocked blocked = Blocked::kNot;
  std::uint16_t age_frames = 0xFFFF;  // frames since its last packet; 0xFFFF: never or longer ago
  std::uint16_t packets = 0;          // packets fused in this frame
  std::uint32_t points = 0;           // points in these packets
  std::uint32_t scan_number = 0;      // number of its last scan
};

}  // namespace iog::intake
