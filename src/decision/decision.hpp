// Masses to a class: what a group's cells are, and what the frames to come ask of them.
//
// Ignorance names nothing: a class needs half of all mass. The map names what the sensors see; it
// never overrules it and never speaks alone.
#pragma once

#include <array>
#include <cstdint>

#include "evidence/assignment.hpp"
#include "evidence/factors.hpp"
#include "evidence/group.hpp"

namespace iog::decision {

// The classes of a cell's byte, which is 8 times the class plus 0 ... 7, how sure it is: floor of
// (mass - 2^14) / 2^11.
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

inline constexpr std::int32_t kSurenessCount = 8;
[[nodiscard]] constexpr Class class_of(std::int8_t byte) {
  return static_cast<Class>(byte / kSurenessCount);
}

// Classes of the map, one bit each; a sum is "one of them".
inline constexpr std::uint8_t kBuilding = 1;
inline constexpr std::uint8_t kRoad = 2;
inline constexpr std::uint8_t kIntermediate = 4;
inline constexpr std::uint8_t kAnywhere = kBuilding + kRoad + kIntermediate;

// Of each cell of the group, bit i for cell i.
struct alignas(8) Bits {
  std::uint8_t freed = 0;   // F > 2^14
  std::uint8_t seen = 0;    // its evidence of this frame was free, and F > 22938
  std::uint8_t stands = 0;  // persistence > 4096
  std::uint8_t taken = 0;   // O + M + K > 8192
  std::uint8_t held = 0;    // O + M + K > 0 or persistence > 0: something but F is known
  friend constexpr bool operator==(const Bits&, const Bits&) = default;
};

// The bytes of a group's cells.
using Decided = std::array<std::int8_t, evidence::kGroupCells>;

// By cell the classes of the map that are impossible there; 0: nothing is known of the map.
using RuledOut = std::array<std::uint8_t, evidence::kGroupCells>;

// Writes what the cells of a group are, by their masses and what is ruled out. Both are aligned to
// 8 bytes. `of_this_frame` is all 0 for a group that is decided without evidence.
Bits decide(const evidence::Free& free, const evidence::Taken& taken, const RuledOut& ruled_out,
            const evidence::Indexes& of_this_frame, Decided& decided);

// Two of the bits.
struct alignas(2) FreeBits {
  std::uint8_t freed = 0;
  std::uint8_t seen = 0;
};

// What decide() does to a group of which nothing is taken: all its other bits are 0.
FreeBits decide_free(const evidence::Free& free, const RuledOut& ruled_out,
                     const evidence::Indexes& of_this_frame, Decided& decided);

// A group that is fused by evidence::fuse_free() and decided by decide_free().
struct Crossed {
  evidence::Free* free;
  const evidence::Fading* fading;
  const evidence::Indexes* indexes;
  const evidence::Gains* gains;
  const RuledOut* ruled_out;
  Decided* decided;
};

// Both of two groups at once: each is as long as the results of the other are waited for.
std::array<FreeBits, 2> cross_free(const std::array<Crossed, 2>& groups);

}  // namespace iog::decision
