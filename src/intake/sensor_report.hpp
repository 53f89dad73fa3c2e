// What is reported about sensors and their packets. The values are on the wire (docs/spec.md).
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::intake {

// Why a datagram was dropped before any of its points was used.
enum class PacketDrop : std::uint8_t {
  kStranger,  // no sensor of this vehicle sends from this source to this port
  kWrongLength,
  kWrongType,
  kWrongAngle,
  kWrongPoint,
  kDuplicate,   // the same packet was fused before
  kLate,        // its scan belongs to a closed frame
  kOverBudget,  // more points than the car file allows in one scan
  kOtherUnit,   // from another unit of the same maker, or from one of two that cannot be told apart
  kNotTaken,    // it waited too long because the target is too slow
  kFrozen,      // new by its stamp, but it repeats the ranges of an earlier packet
  kTooSoon,     // its scan begins sooner after the last one than any unit can scan
};
inline constexpr std::size_t kPacketDropCount = 12;

enum class SensorState : std::uint8_t {
  kNeverSeen,  // not since start
  kSilent,     // nothing in this frame
  kPartial,    // some packets of its scan
  kComplete,   // its whole scan
};

// Where a sensor gets almost no returns (intake/blocked_sectors.hpp).
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
