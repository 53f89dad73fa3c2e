// Masses to a class: what a group's cells are, and what the frames to come ask of them.
//
// Ignorance names nothing: a class needs half of all mass. The map names what the sensors see; it
// never overrules it and never speaks alone.
#pragma once

#include <cstdint>

#include "evidence/assignment.hpp"
#include "evidence/group.hpp"

namespace iog::decision {

// The classes of a byte of Group::decided, which is 8 times the class plus 0 ... 7, how sure it is:
// floor of (mass - 2^14) / 2^11.
enum class Class : std::uint8_t {
  kUnknown,            // always with 0
  kDrivable,           // free, on a road
  kNonDrivable,        // free, beside the roads
  kFree,               // free, and the map does not say where
  kMoving,             // occupied by what moves
  kStopped,            // stands on a road
  kStoppedOrUnmapped,  // stands; what can move and what cannot is not told apart
  kInfrastructure,     // stands where the map has a building
  kOccupied,           // occupied, not yet known by what
};

// Classes of the map, one bit each; a sum is "one of them".
inline constexpr std::uint8_t kBuilding = 1;
inline constexpr std::uint8_t kRoad = 2;
inline constexpr std::uint8_t kIntermediate = 4;
inline constexpr std::uint8_t kAnywhere = kBuilding + kRoad + kIntermediate;

// Of each cell of the group, bit i for cell i.
struct alignas(4) Bits {
  std::uint8_t freed = 0;   // F > 2^14
  std::uint8_t seen = 0;    // its evidence of this frame was free, and F > 22938
  std::uint8_t stands = 0;  // persistence > 4096
  std::uint8_t taken = 0;   // O + M + K > 8192
  friend constexpr bool operator==(const Bits&, const Bits&) = default;
};

// Writes Group::decided, by masses and Group::ruled_out (0 ... 7). `of_this_frame` is all 0 for a
// group that is decided without evidence.
Bits decide(evidence::Group& group, const evidence::Indexes& of_this_frame);

}  // namespace iog::decision
