// Classifies the cells of a group based on their masses, and computes bits that later frames use.
//
// A cell is given a class only if at least half of the total mass supports that class. Ignorance
// therefore never counts towards a class. The map refines the classes that the sensors support. The
// map never overrules the sensors, and it never determines a class without them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "evidence/assignment.hpp"
#include "evidence/factors.hpp"
#include "evidence/group.hpp"

namespace iog::decision {

// The class of a cell. The cell's byte equals 8 times the class plus a confidence of 0 ... 7. The
// confidence is (mass - 2^14) / 2^11, rounded down.
enum class Class : std::uint8_t {
  kUnknown,            // confidence is always 0
  kDrivable,           // free, on a road
  kNonDrivable,        // free, beside the roads
  kFree,               // free, no map data
  kMoving,             // occupied by a moving object
  kStopped,            // static, on a road
  kStoppedOrUnmapped,  // static, movable or not
  kInfrastructure,     // static, where the map has a building
  kOccupied,           // occupied, unclassified
};

inline constexpr std::int32_t kSurenessCount = 8;
[[nodiscard]] constexpr Class class_of(std::int8_t byte) {
  return static_cast<Class>(byte / kSurenessCount);
}

// The classes of the map, with one bit for each class. A sum of bits means "one of these classes".
inline constexpr std::uint8_t kBuilding = 1;
inline constexpr std::uint8_t kRoad = 2;
inline constexpr std::uint8_t kIntermediate = 4;
inline constexpr std::uint8_t kAnywhere = kBuilding + kRoad + kIntermediate;

// Bit i of each member refers to cell i of the group.
struct alignas(8) Bits {
  std::uint8_t freed = 0;   // F > 2^14
  std::uint8_t seen = 0;    // free evidence in this frame, and F > 22938
  std::uint8_t stands = 0;  // persistence > 4096
  std::uint8_t taken = 0;   // O + M + K > 8192
  std::uint8_t held = 0;    // O + M + K > 0 or persistence > 0
  friend constexpr bool operator==(const Bits&, const Bits&) = default;
};

// The class bytes of a group's cells.
using Decided = std::array<std::int8_t, evidence::kGroupCells>;

// For each cell, the map classes that are ruled out. The value is 0 for cells about which the map
// has no information.
using RuledOut = std::array<std::uint8_t, evidence::kGroupCells>;

// Computes and writes the class bytes of a group. The class bytes depend on the group's masses and
// on the classes that are ruled out. Both arrays must be aligned to 8 bytes. If a group is
// classified without new evidence, all elements of `of_this_frame` must be 0.
Bits decide(const evidence::Free& free, const evidence::Taken& taken, const RuledOut& ruled_out,
            const evidence::Indexes& of_this_frame, Decided& decided);

// The members of Bits that decide_free() computes.
struct alignas(2) FreeBits {
  std::uint8_t freed = 0;
  std::uint8_t seen = 0;
};

// Does the same as decide(), but only for groups without occupied mass. All other bits are 0.
FreeBits decide_free(const evidence::Free& free, const RuledOut& ruled_out,
                     const evidence::Indexes& of_this_frame, Decided& decided);

// The arguments of evidence::fuse_free() and decide_free() for consecutive groups. Each pointer
// refers to the first group. The groups share the frame in which they were last aged and the frame
// in which they last had evidence.
struct Crossed {
  evidence::Free* free;
  const evidence::Fading* fading;
  const evidence::Indexes* indexes;
  const evidence::Gains* gains;
  const RuledOut* ruled_out;
  Decided* decided;
};

// Fuses and classifies two or four groups at once. While one group waits for results, the processor
// executes instructions of a different group. Returns the `freed` bits of group i in byte i, and
// its `seen` bits in byte 4 + i.
template <std::size_t kGroups>
[[nodiscard]] std::uint64_t cross_free(const Crossed& groups);
extern template std::uint64_t cross_free<2>(const Crossed& groups);
extern template std::uint64_t cross_free<4>(const Crossed& groups);

}  // namespace iog::decision
