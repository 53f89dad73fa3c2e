// Defines how fast the masses of a cell decay, and how much weight a frame's evidence has. All
// values are in units of 2^-15. `src/ageing` computes them from the timestamps of frames.
#pragma once

#include <cstdint>

namespace iog::evidence {

// The ageing factor 1, which leaves a mass unchanged. An int16 stores the value 2^15 as -2^15.
inline constexpr std::int16_t kWhole = -32768;

// The ageing factors (Kurdej 2015, chapter 6). Each factor is kWhole or in the range 0 ... 32767.
struct alignas(16) Fading {
  std::int16_t free = kWhole;
  std::int16_t occupied = kWhole;
  std::int16_t moving = kWhole;
  std::int16_t standing = kWhole;
  std::int16_t persistence = kWhole;
  friend constexpr bool operator==(const Fading&, const Fading&) = default;
};

// The factors that apply if the elapsed time is too long or unknown. All masses become 0.
inline constexpr Fading kForgotten{0, 0, 0, 0, 0};

// A hit has a mass of 0.87, so it outlasts one 40 ms frame in which beams cross its cell.
inline constexpr std::int16_t kHitMass = 111 * 256;

// The weights of a group's evidence in one frame. Each weight is in the range 0 ... 32767.
struct alignas(16) Gains {
  std::int16_t free_mass = 0;        // f, free mass from crossing beams
  std::int16_t persistence = 0;      // d, the accumulator's increase while the cell is occupied
  std::int16_t decline = 0;          // d_gamma, the accumulator's decrease while the cell is not
                                     // occupied
  std::int16_t specialisation = 0;   // q, the fraction of the accumulator that specialises
  std::int16_t hit_mass = kHitMass;  // o, occupied mass from a hit
  friend constexpr bool operator==(const Gains&, const Gains&) = default;
};

}  // namespace iog::evidence
