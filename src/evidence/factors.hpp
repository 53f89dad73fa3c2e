// Defines the effects of time on a cell, in units of 2^-15. These effects are the decay of the
// cell's masses and the weight of a frame's evidence. `src/ageing` computes both from the
// timestamps of frames.
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

// The factors that apply if the time is too long or unknown. All masses become 0.
inline constexpr Fading kForgotten{0, 0, 0, 0, 0};

// The mass of a hit is 0.87, so that a hit outlasts one free frame of 40 ms.
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
