// The messages of tracked objects (docs/spec.md 3.12). A frame's list is sent in parts, one message
// each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stream/message.hpp"

namespace iog::stream {

// Wire values.
enum class ObjectState : std::uint8_t {
  kYoung = 1,    // object, speed not believed yet
  kStands = 2,   // stationary, never moved
  kMoves = 3,    // moving, with a believed speed
  kStopped = 4,  // has moved, now stationary
};

// Bits of ObjectRecord::flags.
inline constexpr std::uint16_t kObjectHasHeading = 0x0001;
inline constexpr std::uint16_t kObjectNotHit = 0x0002;     // not hit in this frame, predicted
inline constexpr std::uint16_t kObjectEndHidden = 0x0004;  // may be longer or wider

inline constexpr std::uint16_t kNotBelieved = 65535;  // as a deviation of velocity: not believed
inline constexpr std::uint16_t kAtLeast = 65535;      // in other unsigned fields: this or more

// A box on the ground and its motion. Positions and velocities are in the local frame. "Along" is
// the direction of the heading; "across" is to its left.
struct ObjectRecord {
  std::uint32_t id = 0;  // never 0, never reused within a run
  ObjectState state = ObjectState::kYoung;
  std::uint8_t existence = 0;    // confidence that it moves: 255 is the maximum
  std::uint16_t age_frames = 0;  // frames in which it was measured
  std::int32_t x_mm = 0;         // centre of the box at ObjectList::time_us
  std::int32_t y_mm = 0;
  std::uint16_t length_cm = 0;  // along
  std::uint16_t width_cm = 0;   // across
  std::uint16_t heading = 0;    // 2^-16 turns, counter-clockwise from x; 0 if unknown
  std::uint16_t flags = 0;
  std::int16_t vx_cm_s = 0;  // 0 unless the object moves
  std::int16_t vy_cm_s = 0;
  // Standard deviations. Those of the velocity are kNotBelieved for young and stationary objects.
  std::uint16_t sigma_v_along_cm_s = kNotBelieved;
  std::uint16_t sigma_v_across_cm_s = kNotBelieved;
  std::uint16_t sigma_along_mm = 0;
  std::uint16_t sigma_across_mm = 0;
  std::uint16_t since_hit_ms = 0;               // time since the last hit
  std::uint16_t since_stopped_10ms = kAtLeast;  // kAtLeast also if it is moving or has never moved

  [[nodiscard]] constexpr bool has(std::uint16_t flag) const { return (flags & flag) != 0; }
  // True if its velocity, which may be 0, is believed.
  [[nodiscard]] constexpr bool is_believed() const {
    return state == ObjectState::kMoves || state == ObjectState::kStopped;
  }
  friend constexpr bool operator==(const ObjectRecord&, const ObjectRecord&) = default;
};

inline constexpr std::size_t kObjectsHeaderBytes = 24;
inline constexpr std::size_t kMaxObjectsOfAPart = 32;
inline constexpr std::size_t kMaxObjectParts = 8;
inline constexpr std::size_t kMaxObjects = kMaxObjectsOfAPart * kMaxObjectParts;

// The fields common to all parts of a list.
struct ObjectsHeader {
  std::uint64_t time_us = 0;         // ObjectList::time_us
  std::uint16_t objects = 0;         // in the frame, at most kMaxObjects
  std::uint8_t parts = 1;            // 1 ... kMaxObjectParts; 1 for an empty list
  std::uint16_t tracks_refused = 0;  // objects without room since the previous frame
  std::uint16_t hits_left = 0;       // hits not processed since the previous frame
  friend constexpr bool operator==(const ObjectsHeader&, const ObjectsHeader&) = default;
};

// The objects of a frame in ascending order of id.
struct ObjectList {
  // Time of all positions, by the clock of the pose source. If no slice was placed in this frame,
  // the time of an earlier frame. 0: unknown, and the list is empty.
  std::uint64_t time_us = 0;
  std::uint16_t tracks_refused = 0;
  std::uint16_t hits_left = 0;
  std::uint16_t count = 0;
  std::array<ObjectRecord, kMaxObjects> records{};

  [[nodiscard]] constexpr bool has_place() const { return time_us != 0; }
  [[nodiscard]] constexpr std::span<const ObjectRecord> all() const {
    return std::span(records).first(count);
  }
};

// The number of messages for this list: one if the list is empty.
[[nodiscard]] constexpr std::size_t parts_of(const ObjectList& list) {
  return list.count == 0 ? 1 : (list.count + kMaxObjectsOfAPart - 1) / kMaxObjectsOfAPart;
}

// Writes one part; `part` is less than parts_of(list). Returns the number of bytes written, or 0 if
// the buffer is too small.
std::size_t write_objects(const ObjectList& list, std::size_t part, std::span<std::byte> buffer);

struct ObjectPart {
  ObjectsHeader header{};
  std::uint8_t part = 0;
  std::uint8_t count = 0;  // of records
  std::array<ObjectRecord, kMaxObjectsOfAPart> records{};

  [[nodiscard]] constexpr std::span<const ObjectRecord> all() const {
    return std::span(records).first(count);
  }
};

// Skips fields that a later version appends. Returns kOk, kTooShort or kInconsistent. kInconsistent
// means one of: a part number beyond the number of parts; an object count that does not fit the
// parts; objects without a time; a truncated record; ids not in ascending order; an unknown state;
// a velocity or standard deviation that the state excludes.
[[nodiscard]] ReadStatus read_objects(std::span<const std::byte> body, ObjectPart& part);

}  // namespace iog::stream
