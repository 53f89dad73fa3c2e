// Memory layout of a group, eight cells of one row of a tile. The free masses are separate from the
// others: most cells crossed by beams have only free mass, and the others are then neither read nor
// written.
//
// A mass is 0 ... 32767. The ignorance of a cell is 32767 minus its four masses. An unknown cell is
// all zeros.
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

// Two cache lines, read and written in sequence by the kernels that update, fade and decide.
struct alignas(32) Taken {
  Masses occupied{};     // O = {I, M, S, U}: occupied, unclassified
  Masses moving{};       // M = {M}
  Masses standing{};     // K = {I, S, U}
  Masses persistence{};  // the accumulator zeta, not a mass
};
static_assert(sizeof(Taken) == 64);

}  // namespace iog::evidence
