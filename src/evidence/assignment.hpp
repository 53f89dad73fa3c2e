// A basic belief assignment whose masses depend on the magnitude of an occupancy index. An index
// above 0 assigns mass to occupied, and an index below 0 assigns mass to free. The remaining mass
// is ignorance. Without an assignment, all hits share one mass, and all crossing beams share
// another (Gains).
//
// Masses are multiples of 1/128, rounded down. Beyond a magnitude of `kGradedIndexes - 1`, the mass
// of an index no longer changes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "evidence/group.hpp"
#include "index/occupancy_index.hpp"
#include "index/recursive_set.hpp"

namespace iog::evidence {

// The occupancy indexes of a group's cells in one frame, joined from all parts of the frame. Index
// 0 means no evidence.
using Indexes = std::array<index::OccupancyIndex, kGroupCells>;

inline constexpr std::size_t kGradedIndexes = 32;
inline constexpr int kMassFraction = 128;

using MassTable = std::array<std::uint8_t, kGradedIndexes>;

struct alignas(32) Assignment {
  MassTable occupied{};           // by n, 0 ... 127
  MassTable free{};               // by -n; all 0 if time determines the free mass
  std::int16_t free_by_time = 0;  // -1: the free mass is Gains::free_mass
  friend constexpr bool operator==(const Assignment&, const Assignment&) = default;
};

// This function is neither constexpr nor defined. A call at compile time therefore causes a
// compiler error that contains the function's name.
void an_index_beyond_the_table_has_another_mass();

// Returns floor(128 * mass) for 0 <= mass <= 1. The result is capped at 127 to exclude full
// certainty.
consteval std::uint8_t mass_fraction(double mass) {
  return static_cast<std::uint8_t>(std::min(static_cast<int>(mass * kMassFraction), 127));
}

// According to Kurdej 2015, section 4.5.2.2, k echoes give a cell a mass of 1 - 0.2^k. An index of
// 2 corresponds to one echo.
consteval Assignment make_reinforced() {
  Assignment assignment{.free_by_time = -1};
  double doubt = 1;
  for (std::size_t n = 1; n < kGradedIndexes; ++n) {
    doubt *= n % 2 == 1 ? 0.2 : 1;
    assignment.occupied[n] = mass_fraction(1 - doubt);
  }
  return assignment;
}
inline constexpr Assignment kReinforced = make_reinforced();

// For a pignistic probability p_n, the least committed mass is |2 * p_n - 1|, clamped to 0.95. This
// assignment is for comparison only. A hit with an index of +2 has less weight than a crossing beam
// with an index of -14, so the beam erases the hit. The compiler reports an error if the mass of
// index `kGradedIndexes - 1` is below 0.95.
consteval Assignment make_isopignistic(double epsilon) {
  constexpr double kCap = 0.95;
  const index::RecursiveSet set(epsilon);
  Assignment assignment;
  double mass = 0;
  for (std::size_t n = 1; n < kGradedIndexes; ++n) {
    mass = 2 * set.probability(static_cast<std::int32_t>(n)) - 1;
    assignment.occupied[n] = mass_fraction(std::min(mass, kCap));
  }
  if (mass < kCap) {
    an_index_beyond_the_table_has_another_mass();
  }
  assignment.free = assignment.occupied;
  return assignment;
}
inline constexpr Assignment kIsopignistic = make_isopignistic(0.05);

}  // namespace iog::evidence
