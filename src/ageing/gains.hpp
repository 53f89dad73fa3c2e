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

// What the evidence of one frame says about free and occupied.
enum class Weighing : std::uint8_t {
  kByTime,    // crossing beams are worth 0.7 in 100 ms, whatever the frames in it
  kEachScan,  // every frame is a scan of Kurdej 2015, table 7.1: a hit 0.8, a crossing beam 0.7
};

inline constexpr std::int16_t kHitMassOfScan = 102 * 256;  // 0.8, in steps of 1/128, down
inline constexpr std::int16_t kFreeMassOfScan = 89 * 256;  // 0.7

// ms: 1 ... 100.
consteval std::int16_t free_mass_after(std::int32_t ms) {
  constexpr double kDoubtAfter100Ms = 0.3;
  const double doubt = numeric::exp(numeric::log(kDoubtAfter100Ms) * ms / 100);
  return static_cast<std::int16_t>((1 - doubt) * (1 << 15));
}

// The nearest 2^-15 of a part that grows evenly, by numerator / denominator a millisecond; at most
// 32767.
consteval std::int16_t part_after(std::int32_t ms, std::int32_t numerator,
                                  std::int32_t denominator) {
  const auto part = numeric::div_nearest<std::int32_t>((1 << 15) * ms * numerator, denominator);
  return static_cast<std::int16_t>(std::min<std::int32_t>(part, 32767));
}

// ms: 1 ... 100.
consteval evidence::Gains make_gains(std::int32_t ms, Weighing weighing) {
  evidence::Gains gains;
  gains.persistence = part_after(ms, 1, kPersistenceMs);
  gains.decline = part_after(ms, kDeclineToGain, kPersistenceMs);
  gains.specialisation = part_after(ms, kSpecialisationsPerSecond, 1000);
  gains.free_mass = free_mass_after(ms);
  if (weighing == Weighing::kEachScan) {
    gains.free_mass = kFreeMassOfScan;
    gains.hit_mass = kHitMassOfScan;
  }
  return gains;
}

// By ms; no time counts as 1 ms.
using GainsTable = std::array<evidence::Gains, kLongestGainMs + 1>;

consteval GainsTable make_gains_table(Weighing weighing) {
  GainsTable gains{};
  for (std::size_t ms = 0; ms < gains.size(); ++ms) {
    gains[ms] = make_gains(std::max<std::int32_t>(static_cast<std::int32_t>(ms), 1), weighing);
  }
  return gains;
}

inline constexpr GainsTable kGainsByTime = make_gains_table(Weighing::kByTime);
inline constexpr GainsTable kGainsOfScan = make_gains_table(Weighing::kEachScan);

constexpr const evidence::Gains& gains_after(std::uint32_t ms, Weighing weighing) {
  const std::size_t entry = std::min(ms, kLongestGainMs);
  return weighing == Weighing::kByTime ? kGainsByTime[entry] : kGainsOfScan[entry];
}

}  // namespace iog::ageing
