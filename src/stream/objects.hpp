// The messages of things with a speed (docs/spec.md 3.12). The list of a frame goes in parts, each
// a message.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stream/message.hpp"

namespace iog::stream {

// The values are on the wire.
enum class ObjectState : std::uint8_t {
  kYoung = 1,    // something; its speed is not believed
  kStands = 2,   // something that has shown no motion
  kMoves = 3,    // its speed is believed
  kStopped = 4,  // it has moved, and stands
};

// Bits of ObjectRecord::flags.
inline constexpr std::uint16_t kObjectHasHeading = 0x0001;
inline constexpr std::uint16_t kObjectNotHit = 0x0002;     // in this frame: it is predicted
inline constexpr std::uint16_t kObjectEndHidden = 0x0004;  // it may be longer or wider than said

inline constexpr std::uint16_t kNotBelieved = 65535;  // as a deviation of the velocity
inline constexpr std::uint16_t kAtLeast = 65535;      // of all other unsigned fields: or more

// A box on the ground, and how it moves. Places and velocities are of the local frame. Along is
// the direction of its heading, across is to the left of it.
struct ObjectRecord {
  std::uint32_t id = 0;  // not 0, and of no other thing of the run
  ObjectState state = ObjectState::kYoung;
  std::uint8_t existence = 0;    // that it moves: 255 is as sure as can be
  std::uint16_t age_frames = 0;  // in which it was measured
  std::int32_t x_mm = 0;         // of the box's middle, at ObjectList::time_us
  std::int32_t y_mm = 0;
  std::uint16_t length_cm = 0;  // along
  std::uint16_t width_cm = 0;   // across
  std::uint16_t heading = 0;    // 2^-16 turns, counter-clockwise from x; 0 where it is not known
  std::uint16_t flags = 0;
  std::int16_t vx_cm_s = 0;  // 0 but for what moves
  std::int16_t vy_cm_s = 0;
  // Standard deviations. Those of the velocity are kNotBelieved for what is young or stands.
  std::uint16_t sigma_v_along_cm_s = kNotBelieved;
  std::uint16_t sigma_v_across_cm_s = kNotBelieved;
  std::uint16_t sigma_along_mm = 0;
  std::uint16_t sigma_across_mm = 0;
  std::uint16_t since_hit_ms = 0;               // since it was hit last
  std::uint16_t since_stopped_10ms = kAtLeast;  // kAtLeast too if it moves or never has

  [[nodiscard]] constexpr bool has(std::uint16_t flag) const { return (flags & flag) != 0; }
  // Whether its velocity, maybe 0, is one to rely on.
  [[nodiscard]] constexpr bool is_believed() const {
    return state == ObjectState::kMoves || state == ObjectState::kStopped;
  }
  friend constexpr bool operator==(const ObjectRecord&, const ObjectRecord&) = default;
};

inline constexpr std::size_t kObjectsHeaderBytes = 24;
inline constexpr std::size_t kMaxObjectsOfAPart = 32;
inline constexpr std::size_t kMaxObjectParts = 8;
inline constexpr std::size_t kMaxObjects = kMaxObjectsOfAPart * kMaxObjectParts;

// What every part of a list says.
struct ObjectsHeader {
  std::uint64_t time_us = 0;         // as ObjectList
  std::uint16_t objects = 0;         // in the frame, at most kMaxObjects
  std::uint8_t parts = 1;            // 1 ... kMaxObjectParts, also without objects
  std::uint16_t tracks_refused = 0;  // things without room; since the frame before, as the next
  std::uint16_t hits_left = 0;       // that were not looked at
  friend constexpr bool operator==(const ObjectsHeader&, const ObjectsHeader&) = default;
};

// A frame's list: ids rise.
struct ObjectList {
  // Of all places, by the clock of the pose source; that of an earlier frame if nothing was placed
  // in this one. 0: nothing is known, and the list is empty.
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

// How many messages it takes: one if there is none.
[[nodiscard]] constexpr std::size_t parts_of(const ObjectList& list) {
  return list.count == 0 ? 1 : (list.count + kMaxObjectsOfAPart - 1) / kMaxObjectsOfAPart;
}

// Writes a part, below parts_of(list). Returns the bytes written, 0 if the buffer is too small.
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

// Fields of a later version behind ours are skipped. kOk; kTooShort; or kInconsistent: a part
// beyond its parts, more objects than they can hold or fewer, objects without a time, bytes that
// are no whole objects, ids that do not rise, an unknown state, a speed of what is not believed to
// move.
[[nodiscard]] ReadStatus read_objects(std::span<const std::byte> body, ObjectPart& part);

}  // namespace iog::stream
