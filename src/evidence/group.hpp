// Eight cells of one row of a tile, as they lie in memory. What is free of them lies apart from the
// rest: most cells that beams cross are free and nothing else, and for them the rest is neither
// read nor written.
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

struct alignas(16) Masses : std::array<std::int16_t, kGroupCells> {};
static_assert(sizeof(Masses) == 16);

using Free = Masses;  // F = {D, N}

// Two cache lines, one stream for the kernels that update, fade and decide.
struct alignas(32) Taken {
  Masses occupied{};     // O = {I, M, S, U}: not yet known by what
  Masses moving{};       // M = {M}
  Masses standing{};     // K = {I, S, U}
  Masses persistence{};  // the accumulator zeta, no mass
};
static_assert(sizeof(Taken) == 64);

}  // namespace iog::evidence
