// The weights of a frame's evidence, which depend on the time since the last evidence. If a cell is
// observed twice as often, each observation has half the weight.
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

// Constants of Kurdej 2015, section 7.3. The accumulator is full after 3 s. This is the time in
// which an object of 3 m length passes a point at 1 m/s, the slowest speed that is treated as
// motion. The accumulator decreases 6 times as fast as it increases (gamma). A full accumulator
// specialises all mass within one scan at the scan rate of the thesis, 15 Hz.
inline constexpr std::int32_t kPersistenceMs = 3000;
inline constexpr std::int32_t kDeclineToGain = 6;
inline constexpr std::int32_t kSpecialisationsPerSecond = 15;

// The rule by which the free and occupied evidence of a frame is weighted.
enum class Weighing : std::uint8_t {
  kByTime,    // crossing beams have a weight of 0.7 per 100 ms, at any frame rate
  kEachScan,  // every frame is a scan as in Kurdej 2015, table 7.1: 0.8 per hit, 0.7 per crossing
              // beam
};

inline constexpr std::int16_t kHitMassOfScan = 102 * 256;  // 0.8, rounded down to a multiple of
                                                           // 1/128
inline constexpr std::int16_t kFreeMassOfScan = 89 * 256;  // 0.7

// ms: 1 ... 100.
consteval std::int16_t free_mass_after(std::int32_t ms) {
  constexpr double kDoubtAfter100Ms = 0.3;
  const double doubt = numeric::exp(numeric::log(kDoubtAfter100Ms) * ms / 100);
  return static_cast<std::int16_t>((1 - doubt) * (1 << 15));
}

// A fraction that increases linearly by numerator / denominator per millisecond. The result is in
// units of 2^-15, rounded to nearest, and at most 32767.
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

// Indexed by time in ms. The entry for 0 ms equals the entry for 1 ms.
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
