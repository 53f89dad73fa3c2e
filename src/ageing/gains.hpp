// The weights of a frame's evidence depend on the time since the last evidence. If a cell is
// observed twice as often, each observation has half as much weight.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "ageing/decay.hpp"
#include "evidence/factors.hpp"
#include "numeric/division.hpp"
#include "numeric/elementary.hpp"

namespace iog::ageing {

inline constexpr std::uint32_t kLongestGainMs = 100;

// The constants of Kurdej 2015, section 7.3. These constants describe an object of length L = 3 m
// that moves at V_min = 1 m/s or faster, at a distance of d = 0.5 m behind another object. The
// accumulator fills in the time delta = L / V_min and empties in the time d / V_min =
// delta / gamma, where gamma = L / d = 6. At the scan rate of the thesis, a full accumulator
// specialises all of a cell's occupied mass within one scan (evidence/cell.hpp).
struct Accumulation {
  std::uint16_t full_ms = 3000;
  std::uint16_t empty_ms = 500;
  std::uint16_t specialisations_per_second = 15;
  friend constexpr bool operator==(const Accumulation&, const Accumulation&) = default;
};

// Specifies how a frame's free and occupied evidence is weighted.
enum class Weighing : std::uint8_t {
  kByTime,    // crossing beams have a weight of 0.7 per 100 ms, at any frame rate
  kEachScan,  // every frame is a scan as in Kurdej 2015, table 7.1: 0.8 per hit, 0.7 per crossing
              // beam
};

inline constexpr std::int16_t kHitMassOfScan = 102 * 256;  // 0.8, rounded down to a multiple of
                                                           // 1/128
inline constexpr std::int16_t kFreeMassOfScan = 89 * 256;  // 0.7

// The ignorance that remains after beams have crossed a cell for 100 ms. These beams contribute the
// remaining mass of 0.7.
inline constexpr double kDoubtAfter100Ms = 0.3;

// Returns the mass that beams contribute to a cell by crossing it for a given time, from 1 to
// 100 ms. This function runs only on a PC or at compile time.
constexpr std::int16_t free_mass_after(std::int32_t ms, double doubt_after_100_ms) {
  const double doubt = numeric::exp(numeric::log(doubt_after_100_ms) * ms / 100);
  return static_cast<std::int16_t>((1 - doubt) * (1 << 15));
}

// Returns `ms * numerator / denominator`. The result is in units of 2^-15, rounded to the nearest
// unit, and at most 32767.
constexpr std::int16_t part_after(std::int32_t ms, std::int32_t numerator,
                                  std::int32_t denominator) {
  const auto part = numeric::div_nearest<std::int32_t>((1 << 15) * ms * numerator, denominator);
  return static_cast<std::int16_t>(std::min<std::int32_t>(part, 32767));
}

// The mass that crossing beams contribute to a cell, indexed by time in ms. The entry for 0 ms
// equals the entry for 1 ms.
using FreeMasses = std::array<std::int16_t, kLongestGainMs + 1>;

// This function runs only on a PC or at compile time.
constexpr FreeMasses make_free_masses(double doubt_after_100_ms) {
  FreeMasses masses{};
  for (std::size_t ms = 0; ms < masses.size(); ++ms) {
    masses[ms] = free_mass_after(std::max<std::int32_t>(static_cast<std::int32_t>(ms), 1),
                                 doubt_after_100_ms);
  }
  return masses;
}

// The weights, indexed by time in ms. The entry for 0 ms equals the entry for 1 ms.
using GainsTable = std::array<evidence::Gains, kLongestGainMs + 1>;

constexpr GainsTable make_gains_table(const Accumulation& accumulation, const FreeMasses& free,
                                      std::int16_t hit_mass) {
  GainsTable table{};
  for (std::size_t entry = 0; entry < table.size(); ++entry) {
    const auto ms = std::max<std::int32_t>(static_cast<std::int32_t>(entry), 1);
    evidence::Gains& gains = table[entry];
    gains.persistence = part_after(ms, 1, accumulation.full_ms);
    gains.decline = part_after(ms, 1, accumulation.empty_ms);
    gains.specialisation = part_after(ms, accumulation.specialisations_per_second, 1000);
    gains.free_mass = free[entry];
    gains.hit_mass = hit_mass;
  }
  return table;
}

consteval FreeMasses free_mass_of_scan() {
  FreeMasses masses{};
  masses.fill(kFreeMassOfScan);
  return masses;
}

inline constexpr GainsTable kGainsByTime =
    make_gains_table({}, make_free_masses(kDoubtAfter100Ms), evidence::kHitMass);
inline constexpr GainsTable kGainsOfScan =
    make_gains_table({}, free_mass_of_scan(), kHitMassOfScan);

constexpr const evidence::Gains& gains_after(std::uint32_t ms, const GainsTable& table) {
  return table[std::min(ms, kLongestGainMs)];
}

// The tables for a car file that defines its own evidential constants (docs/vehicles.md).
struct Tables {
  Decays decays{};
  Accumulation accumulation{};
  FreeMasses free{};
  std::int16_t hit_mass = 0;
  GainsTable gains{};  // made of the three members before it
  friend constexpr bool operator==(const Tables&, const Tables&) = default;
};

}  // namespace iog::ageing
