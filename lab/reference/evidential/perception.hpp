// A cell of the thesis's perception grid, in double precision and over all 64 sets (Kurdej 2015,
// chapters 4, 5 and 8).
//
// Slips of the text, and how they are read here:
// - Equation 5.9 writes Dempster's sign; the rule without normalisation is meant, else conflict
//   would count twice. Conflict that is neither of the two kinds has no rule there: as with Yager
//   it is ignorance.
// - Equation 5.8 sends a part of {M} to the empty set, of which nothing is said: it is ignorance.
//   Only so is the cell of section 5.4 called stopped in scans 12 and 10.
// - The rates of table 7.1 are those of contextual discounting, which hit the complement. For all
//   other schemes they are exchanged.
#pragma once

#include <array>
#include <cstdint>

#include "lab/reference/evidential/mass_function.hpp"

namespace iog::lab::reference::evidential {

// The frame of discernment of the PerceptionGrid.
inline constexpr int kPerceptionElements = 6;
inline constexpr Set kDrivable = 1;     // D, free
inline constexpr Set kNonDrivable = 2;  // N, free
inline constexpr Set kMapped = 4;       // I, mapped infrastructure
inline constexpr Set kMoving = 8;       // M
inline constexpr Set kStopped = 16;     // S
inline constexpr Set kUnmapped = 32;    // U, infrastructure that no map has
inline constexpr Set kFree = kDrivable | kNonDrivable;
inline constexpr Set kOccupied = kMapped | kMoving | kStopped | kUnmapped;
inline constexpr Set kStanding = kOccupied & ~kMoving;
inline constexpr Set kAnything = kFree | kOccupied;
// The partition Theta of section 6.2.1.
inline constexpr Set kDynamic = kFree | kMoving;
inline constexpr Set kStatic = kStanding;

// The frame of a lidar's SourceGrid, and r_S (equation 4.1).
inline constexpr Set kSourceFree = 1;
inline constexpr Set kSourceOccupied = 2;
inline constexpr std::array<Set, 2> kSourceImages{kFree, kOccupied};

// The frame of the GISGrid, and r_GG (equation 4.3). What may be in a cell at a border is a union.
inline constexpr Set kBuilding = 1;
inline constexpr Set kRoad = 2;
inline constexpr Set kIntermediate = 4;
inline constexpr std::array<Set, 3> kMapImages{kMapped, kDrivable | kStopped | kMoving,
                                               kNonDrivable | kUnmapped | kStopped | kMoving};

// What a lidar's scan and what the map says of a cell, both refined (equations 4.2 and 4.4). The
// masses of one call add up to at most 1. Both without evidence are vacuous.
[[nodiscard]] MassFunction source_evidence(double free, double occupied);
[[nodiscard]] MassFunction map_evidence(Set map_classes, double beta);

// m_PG(F) and m_PG(O) of section 5.2.2: of all non-empty subsets.
[[nodiscard]] double free_mass(const MassFunction& mass);
[[nodiscard]] double occupied_mass(const MassFunction& mass);

struct TemporalFusion {
  MassFunction mass{kPerceptionElements};
  double appeared = 0;     // conflict FO (equation 5.4): free before, occupied now
  double disappeared = 0;  // conflict OF: occupied before, free now
  double other = 0;        // conflict of neither kind, as of {M} with a mapped building

  [[nodiscard]] double conflict() const { return appeared + disappeared + other; }
};

// How a scan joins what is known: by equation 5.9, which is neither commutative nor associative, or
// by one of the rules of section 3.5 in its place.
enum class TemporalRule : std::uint8_t { kThesis, kConjunctive, kDempster, kYager, kDisjunctive };

// The grid so far with the SensorGrid of a scan. By the conjunctive rule conflict stays with the
// empty set, and is conflict of neither kind from then on; by the disjunctive one there is none.
[[nodiscard]] TemporalFusion fused_in_time(const MassFunction& before, const MassFunction& now,
                                           TemporalRule rule = TemporalRule::kThesis);

// Equations 5.5 and 5.6. gain: delta; decline: gamma, how much faster the accumulator falls.
[[nodiscard]] double accumulated(double accumulator, const TemporalFusion& fusion, double gain,
                                 double decline);

enum class Specialised : std::uint8_t {
  kEverySet,      // equation 5.8 to the letter: ignorance, too, becomes "anything but moving"
  kOccupiedSets,  // ignorance and every set with something free in it stay as they are
};

// Equation 5.7: a share of every set with M in it goes to the set without M.
[[nodiscard]] MassFunction specialised(const MassFunction& mass, double share, Specialised which);

enum class Ageing : std::uint8_t {
  kClassical,  // everything like the dynamic classes
  kContextual,
  kConservative,
  kOptimistic,
  kProportional,
};

// Of one scan, however long after the last.
struct ScanParameters {
  Ageing ageing = Ageing::kConservative;
  TemporalRule rule = TemporalRule::kThesis;
  double dynamic_loss = 0.10;    // of the mass of a singleton out of D, N, M
  double static_loss = 0.01;     // out of I, S, U
  double gain = 0.02;            // delta
  double decline = 6;            // gamma
  double specialised_share = 1;  // of the accumulator
  Specialised which = Specialised::kEverySet;
};

[[nodiscard]] MassFunction aged(const MassFunction& mass, const ScanParameters& parameters);

struct PerceptionCell {
  MassFunction mass{kPerceptionElements};
  double accumulator = 0;  // zeta

  // Section 5.2: discounting, fusion, accumulation, specialisation. What the scan says is, as the
  // thesis has it, dempster(source_evidence(...), map_evidence(...)) (equation 5.2): the map once
  // more in every scan. With source_evidence() alone the cell knows no map, and
  // dempster(mass, map_evidence(...)) is what it says together with the map.
  // What it returns is before the specialisation.
  TemporalFusion scan(const MassFunction& sensor_grid, const ScanParameters& parameters);

  // Time alone.
  void pass(const ScanParameters& parameters) { mass = aged(mass, parameters); }
};

// The simple decision of sections 8.1 and 8.2: the class whose pignistic probability reaches its
// threshold, 0.5 and for stopped 0.35; of several the most probable. 0: unknown.
[[nodiscard]] Set pignistic_decision(const MassFunction& mass);

}  // namespace iog::lab::reference::evidential
