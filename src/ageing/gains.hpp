// How much the evidence of a frame weighs, by the time since the last one. A cell that is looked at
// twice as often learns half as much from each look.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "evidence/factors.hpp"
#include "numeric/division.hpp"
#include "numeric/elementary.hpp"

namespace iog::ageing {

inline constexpr std::uint32_t kLongestGainMs = 100;

// Kurdej 2015, section 7.3. The accumulator is full after 3 s, the time in which something 3 m long
// passes at the slowest speed that is motion, 1 m/s. It falls 6 times as fast (gamma). A full
// accumulator specialises everything in one scan of the thesis's 15 Hz.
inline constexpr std::int32_t kPersistenceMs = 3000;
inline constexpr std::int32_t kDeclineToGain = 6;
inline constexpr std::int32_t kSpecialisationsPerSecond = 15;

// ms: 1 ... 100.
consteval evidence::Gains make_gains(std::int32_t ms) {
  constexpr std::int32_t kOne = 1 << 15;
  constexpr double kPassedBy = 0.3;  // of the doubt of a free cell, what 100 ms of beams leave
  const double doubt = numeric::exp(numeric::log(kPassedBy) * ms / 100);
  const std::int32_t specialisation =
      numeric::div_nearest<std::int32_t>(kOne * ms * kSpecialisationsPerSecond, 1000);
  return {.free_mass = static_cast<std::int16_t>((1 - doubt) * kOne),
          .persistence = static_cast<std::int16_t>(
              numeric::div_nearest<std::int32_t>(kOne * ms, kPersistenceMs)),
          .decline = static_cast<std::int16_t>(
              numeric::div_nearest<std::int32_t>(kDeclineToGain * kOne * ms, kPersistenceMs)),
          .specialisation =
              static_cast<std::int16_t>(std::min<std::int32_t>(specialisation, kOne - 1))};
}

// By ms; no time counts as 1 ms.
consteval auto make_all_gains() {
  std::array<evidence::Gains, kLongestGainMs + 1> gains{};
  for (std::size_t ms = 0; ms < gains.size(); ++ms) {
    gains[ms] = make_gains(std::max<std::int32_t>(static_cast<std::int32_t>(ms), 1));
  }
  return gains;
}
inline constexpr auto kGains = make_all_gains();

}  // namespace iog::ageing
