// Weights of a frame's evidence, by the time since the last evidence. A cell that is observed twice
// as often learns half as much from each observation.
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

// Constants of Kurdej 2015, section 7.3. The accumulator is full after 3 s, the time in which an
// object 3 m long passes at 1 m/s, the slowest speed that counts as motion. It falls 6 times as
// fast (gamma). A full accumulator specialises all mass within one scan of the thesis's 15 Hz.
inline constexpr std::int32_t kPersistenceMs = 3000;
inline constexpr std::int32_t kDeclineToGain = 6;
inline constexpr std::int32_t kSpecialisationsPerSecond = 15;

// How the evidence of a frame is weighed for free and occupied.
enum class Weighing : std::uint8_t {
  kByTime,    // crossing beams are worth 0.7 per 100 ms, for any frame rate
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

// A fraction that grows linearly by numerator / denominator per millisecond, in units of 2^-15,
// rounded to nearest. At most 32767.
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

// Indexed by ms; 0 ms counts as 1 ms.
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
