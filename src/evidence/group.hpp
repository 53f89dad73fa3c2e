// Eight cells of one row of a tile, as they lie in memory: 96 bytes, three cache lines of a
// Cortex-A9, one stream for the kernels that update, fade and decide.
//
// A mass is 0 ... 32767, and what the four masses of a cell leave of 32767 is ignorance. A cell of
// which nothing is known is all zeros.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace iog::evidence {

inline constexpr std::size_t kGroupCells = 8;
inline constexpr std::int16_t kCertain = 32767;

using Masses = std::array<std::int16_t, kGroupCells>;

struct alignas(32) Group {
  Masses free{};         // F = {D, N}
  Masses occupied{};     // O = {I, M, S, U}: not yet known by what
  Masses moving{};       // M = {M}
  Masses standing{};     // K = {I, S, U}
  Masses persistence{};  // the accumulator zeta, no mass
  // The map's classes that are impossible here; 0: nothing is known of the map.
  std::array<std::uint8_t, kGroupCells> ruled_out{};
  std::array<std::int8_t, kGroupCells> decided{};  // class times 8 plus sureness
};
static_assert(sizeof(Group) == 96);

}  // namespace iog::evidence
