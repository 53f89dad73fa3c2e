// What time does to a cell, in units of 2^-15: how much of its masses is left, and how much the
// evidence of one frame weighs. src/ageing makes both from the stamps of frames.
#pragma once

#include <cstdint>

namespace iog::evidence {

// A factor of ageing that leaves a mass as it is: 2^15, which an int16 holds as -2^15.
inline constexpr std::int16_t kWhole = -32768;

// The factors of ageing (Kurdej 2015, chapter 6): 0 ... 32767, or kWhole.
struct alignas(16) Fading {
  std::int16_t free = kWhole;
  std::int16_t occupied = kWhole;
  std::int16_t moving = kWhole;
  std::int16_t standing = kWhole;
  std::int16_t persistence = kWhole;
  friend constexpr bool operator==(const Fading&, const Fading&) = default;
};

// What is left after a time that is too long or not known: nothing.
inline constexpr Fading kForgotten{0, 0, 0, 0, 0};

// A hit is worth 0.87, so that it outlives one free frame of 40 ms.
inline constexpr std::int16_t kHitMass = 111 * 256;

// The weights of a group's evidence in one frame, 0 ... 32767.
struct alignas(16) Gains {
  std::int16_t free_mass = 0;        // f, what crossing beams say against a cell
  std::int16_t persistence = 0;      // d, the accumulator's gain while the cell is occupied
  std::int16_t decline = 0;          // d_gamma, its loss while it is not
  std::int16_t specialisation = 0;   // q, the part of the accumulator that specialises
  std::int16_t hit_mass = kHitMass;  // o, what a hit says for a cell
  friend constexpr bool operator==(const Gains&, const Gains&) = default;
};

}  // namespace iog::evidence
