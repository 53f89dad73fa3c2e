// The messages that contain tracked objects (docs/spec.md 3.12). The object list of a frame is sent
// in parts, with one message per part.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stream/message.hpp"

namespace iog::stream {

// The values of this enumeration are part of the wire format.
enum class ObjectState : std::uint8_t {
  kYoung = 1,    // newly detected; its speed is not confirmed yet
  kStands = 2,   // stationary; has never moved
  kMoves = 3,    // moving; its speed is confirmed
  kStopped = 4,  // has moved and is now stationary
};

// The bits of ObjectRecord::flags.
inline constexpr std::uint16_t kObjectHasHeading = 0x0001;
inline constexpr std::uint16_t kObjectNotHit = 0x0002;     // not hit in this frame; predicted
inline constexpr std::uint16_t kObjectEndHidden = 0x0004;  // may be longer or wider than measured

inline constexpr std::uint16_t kNotBelieved = 65535;  // as a velocity's deviation: not confirmed
inline constexpr std::uint16_t kAtLeast = 65535;      // in other unsigned fields: 65535 or more

// An object's box on the ground, and its motion. Positions and velocities are in the local frame.
// "Along" is the direction of the heading, and "across" is the direction to its left.
struct ObjectRecord {
  std::uint32_t id = 0;  // never 0 and never reused within a run
  ObjectState state = ObjectState::kYoung;
  std::uint8_t existence = 0;    // confidence that it moves; the maximum is 255
  std::uint16_t age_frames = 0;  // number of frames in which it was measured
  std::int32_t x_mm = 0;         // centre of the box at ObjectList::time_us
  std::int32_t y_mm = 0;
  std::uint16_t length_cm = 0;  // size in the direction of the heading
  std::uint16_t width_cm = 0;   // size across the heading
  std::uint16_t heading = 0;    // in 2^-16 turns, counter-clockwise from x; 0 if unknown
  std::uint16_t flags = 0;
  std::int16_t vx_cm_s = 0;  // 0 unless the object is moving
  std::int16_t vy_cm_s = 0;
  // The standard deviations of velocity and position, along and across the heading. For young and
  // stationary objects, the standard deviations of the velocity are kNotBelieved.
  std::uint16_t sigma_v_along_cm_s = kNotBelieved;
  std::uint16_t sigma_v_across_cm_s = kNotBelieved;
  std::uint16_t sigma_along_mm = 0;
  std::uint16_t sigma_across_mm = 0;
  std::uint16_t since_hit_ms = 0;               // time since the last hit
  std::uint16_t since_stopped_10ms = kAtLeast;  // also kAtLeast if it is moving or has never moved

  [[nodiscard]] constexpr bool has(std::uint16_t flag) const { return (flags & flag) != 0; }
  // Returns true if the velocity is confirmed. A confirmed velocity may be 0.
  [[nodiscard]] constexpr bool is_believed() const {
    return state == ObjectState::kMoves || state == ObjectState::kStopped;
  }
  friend constexpr bool operator==(const ObjectRecord&, const ObjectRecord&) = default;
};

inline constexpr std::size_t kObjectsHeaderBytes = 24;
inline constexpr std::size_t kMaxObjectsOfAPart = 32;
inline constexpr std::size_t kMaxObjectParts = 8;
inline constexpr std::size_t kMaxObjects = kMaxObjectsOfAPart * kMaxObjectParts;

// The fields that are the same in all parts of a list.
struct ObjectsHeader {
  std::uint64_t time_us = 0;         // equal to ObjectList::time_us
  std::uint16_t objects = 0;         // number of objects in the frame, at most kMaxObjects
  std::uint8_t parts = 1;            // 1 to kMaxObjectParts; 1 if the list is empty
  std::uint16_t tracks_refused = 0;  // objects since the previous frame that did not fit
  std::uint16_t hits_left = 0;       // hits not processed since the previous frame
  friend constexpr bool operator==(const ObjectsHeader&, const ObjectsHeader&) = default;
};

// The objects of a frame, sorted by ascending ID.
struct ObjectList {
  // The time at which the positions apply, by the pose source's clock. If no slice was placed in
  // this frame, the time comes from an earlier frame. If the value is 0, the time is unknown and
  // the list is empty.
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

// Returns the number of messages needed for the list. Even an empty list is sent as one message.
[[nodiscard]] constexpr std::size_t parts_of(const ObjectList& list) {
  return list.count == 0 ? 1 : (list.count + kMaxObjectsOfAPart - 1) / kMaxObjectsOfAPart;
}

// Writes one part. Requires part < parts_of(list). Returns the number of bytes written, or 0 if the
// buffer is too small.
std::size_t write_objects(const ObjectList& list, std::size_t part, std::span<std::byte> buffer);

struct ObjectPart {
  ObjectsHeader header{};
  std::uint8_t part = 0;
  std::uint8_t count = 0;  // number of records
  std::array<ObjectRecord, kMaxObjectsOfAPart> records{};

  [[nodiscard]] constexpr std::span<const ObjectRecord> all() const {
    return std::span(records).first(count);
  }
};

// Reads one part. Skips fields that a later version may append. Returns kOk, kTooShort or
// kInconsistent. A part is inconsistent in any of these cases:
//   * The part number is not less than the number of parts, or the object count does not match the
//     number of parts.
//   * The part has objects but no time, or a record is truncated.
//   * The IDs are not in ascending order.
//   * A record has an unknown state, or has a velocity or standard deviation that its state does
//     not allow.
[[nodiscard]] ReadStatus read_objects(std::span<const std::byte> body, ObjectPart& part);

}  // namespace iog::stream
