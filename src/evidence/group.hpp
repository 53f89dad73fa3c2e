// Defines the memory layout of a group, which consists of eight consecutive cells in a row of a
// tile. The free masses are stored separately from the other masses. Most crossed cells have only
// free mass, so their other masses are neither read nor written.
//
// Masses are in the range 0 ... 32767. The ignorance of a cell is 32767 minus the sum of its four
// masses. In an unknown cell, all values are 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace iog::evidence {

inline constexpr std::size_t kGroupCells = 8;
inline constexpr std::int16_t kCertain = 32767;

struct alignas(16) Masses : std::array<std::int16_t, kGroupCells> {};
static_assert(sizeof(Masses) == 16);

using Free = Masses;  // F = {D, N}

// The masses of Taken occupy two cache lines. The kernels for updating, ageing and deciding read
// and write these masses sequentially.
struct alignas(32) Taken {
  Masses occupied{};     // O = {I, M, S, U}: occupied, unclassified
  Masses moving{};       // M = {M}
  Masses standing{};     // K = {I, S, U}
  Masses persistence{};  // the accumulator zeta, not a mass
};
static_assert(sizeof(Taken) == 64);

}  // namespace iog::evidence
