// The map in every scan, as Kurdej's thesis has it, against the map at the decision: where both
// know the same of what is seen, and what a mapped building does that does not exist.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "lab/experiments/evidential/names.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/reference/evidential/sensor_part.hpp"
#include "tools/simulate/random.hpp"

namespace iog::lab {
namespace {

using reference::evidential::Ageing;
using reference::evidential::commutes_with_ageing;
using reference::evidential::commutes_with_specialisation;
using reference::evidential::commutes_with_the_scan;
using reference::evidential::dempster;
using reference::evidential::free_mass;
using reference::evidential::grid_sets;
using reference::evidential::kBuilding;
using reference::evidential::kFree;
using reference::evidential::kMapImages;
using reference::evidential::kMapped;
using reference::evidential::kRoad;
using reference::evidential::kStanding;
using reference::evidential::map_evidence;
using reference::evidential::MassFunction;
using reference::evidential::PerceptionCell;
using reference::evidential::pignistic;
using reference::evidential::ScanParameters;
using reference::evidential::sensor_part_difference;
using reference::evidential::Set;
using reference::evidential::some_scan_with;
using reference::evidential::source_evidence;
using reference::evidential::Specialised;
using reference::evidential::without_map;

constexpr int kRounds = 20;
constexpr int kScansOfRound = 200;
constexpr std::array kBeliefs{0.97, 0.99};  // of table 7.1: OpenStreetMap, IGN

MassFunction with_map(const MassFunction& mass, Set map_class, double belief) {
  return map_class == 0 ? mass : dempster(mass, map_evidence(map_class, belief));
}

// Phases in which a cell is unseen, free, occupied or both; random masses and rates. The same scans
// once with the map in each and once without.
double difference_in_a_round(Set map_class, const Named<Ageing>& ageing,
                             const Named<Specialised>& which, tools::Random& random) {
  PerceptionCell early;
  PerceptionCell late;
  double worst = 0;
  std::uint64_t phase = 0;
  for (int scan = 0; scan < kScansOfRound; ++scan) {
    phase = random.chance(1.0 / 12) ? random.below(4) : phase;
    const double free = phase == 1 || phase == 3 ? random.between(0, 0.9) : 0;
    const double occupied = phase >= 2 ? random.between(0, 0.95 - free) : 0;
    const ScanParameters parameters{.ageing = ageing.choice,
                                    .dynamic_loss = random.between(0, 0.3),
                                    .static_loss = random.between(0, 0.1),
                                    .gain = random.between(0, 0.2),
                                    .decline = random.between(0, 6),
                                    .which = which.choice};
    const MassFunction source = source_evidence(free, occupied);
    early.scan(with_map(source, map_class, 0.97), parameters);
    late.scan(source, parameters);
    worst = std::max(worst, sensor_part_difference(early, late));
  }
  return worst;
}

// All sets of a cell with this map, and those of them that do not know the same without it.
struct SetCounts {
  std::size_t all = 0;
  std::size_t by_scan = 0;
  std::size_t by_specialisation = 0;
  std::size_t by_ageing = 0;
};

SetCounts sets_that_differ(Set map_class, const ScanParameters& parameters) {
  SetCounts counts;
  for (const Set set : grid_sets(map_class, parameters)) {
    ++counts.all;
    counts.by_scan += commutes_with_the_scan(set, map_class) ? 0U : 1U;
    counts.by_specialisation += commutes_with_specialisation(set, parameters.which) ? 0U : 1U;
    counts.by_ageing += commutes_with_ageing(set, parameters) ? 0U : 1U;
  }
  return counts;
}

// The mass that the map alone moves to what stands, of one scan that knows nothing of it.
double added_by_a_scan(Set map_class) { return without_map(some_scan_with(map_class))[kStanding]; }

// Of rounding only the size: its digits differ from one C library to another.
double shown(double difference) {
  return difference < 1e-9 ? difference_bound(difference) : std::round(difference * 1e3) / 1e3;
}

Table differences() {
  Table table("evidential_map_order",
              {"context", "ageing", "specialised", "sets", "sets_not_kept_by_scan",
               "sets_not_kept_by_specialisation", "sets_not_kept_by_ageing", "added_by_a_scan",
               "scans", "difference"});
  for (const auto& context : kContexts) {
    for (const auto& ageing : kAgeings) {
      for (const auto& which : kSpecialisations) {
        const SetCounts sets =
            sets_that_differ(context.choice, {.ageing = ageing.choice, .which = which.choice});
        tools::Random random(5, context.choice);
        double worst = 0;
        for (int round = 0; round < kRounds; ++round) {
          worst = std::max(worst, difference_in_a_round(context.choice, ageing, which, random));
        }
        table.row(context.name, ageing.name, which.name, sets.all, sets.by_scan,
                  sets.by_specialisation, sets.by_ageing, added_by_a_scan(context.choice),
                  kRounds * kScansOfRound, shown(worst));
      }
    }
  }
  return table;
}

// A mapped building that does not exist, seen free in every scan. gain: equation 7.4 at 10 Hz.
Table ghost() {
  Table table("evidential_ghost", {"map", "belief", "scan", "free_mass", "mapped", "free"});
  constexpr ScanParameters kTenHertz{.gain = 1.0 / 30, .which = Specialised::kOccupiedSets};
  const MassFunction source = source_evidence(0.7, 0);
  for (const double belief : kBeliefs) {
    for (const bool in_every_scan : {true, false}) {
      PerceptionCell cell;
      for (int scan = 1; scan <= 100; ++scan) {
        cell.scan(in_every_scan ? with_map(source, kBuilding, belief) : source, kTenHertz);
        const MassFunction said =
            in_every_scan ? cell.mass : with_map(cell.mass, kBuilding, belief);
        table.row(in_every_scan ? "every scan" : "decision", belief, scan, free_mass(cell.mass),
                  pignistic(said, kMapped), pignistic(said, kFree));
      }
    }
  }
  return table;
}

// Nothing is seen; the map alone speaks, in every scan.
Table map_alone() {
  Table table("evidential_map_alone", {"belief", "scan", "mass"});
  for (const double belief : kBeliefs) {
    PerceptionCell cell;
    for (int scan = 1; scan <= 20; ++scan) {
      cell.scan(map_evidence(kRoad, belief), {});
      table.row(belief, scan, cell.mass[kMapImages[1]]);
    }
  }
  return table;
}

}  // namespace

Tables evidential_map(const Input& /*input*/) { return {differences(), ghost(), map_alone()}; }

}  // namespace iog::lab
