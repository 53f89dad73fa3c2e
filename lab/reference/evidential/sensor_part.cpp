#include "lab/reference/evidential/sensor_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lab/reference/evidential/focal_sets.hpp"

namespace iog::lab::reference::evidential {
namespace {

MassFunction certain_of(Set set) { return MassFunction(kPerceptionElements, {{set, 1}}); }

double largest_difference(const MassFunction& one, const MassFunction& other) {
  double largest = 0;
  for (Set a = 0; a <= one.frame(); ++a) {
    largest = std::max(largest, std::abs(one[a] - other[a]));
  }
  return largest;
}

std::vector<Set> sets_in(const FocalSets& focal) {
  std::vector<Set> sets;
  for (Set a = 1; a <= kAnything; ++a) {
    if (focal[a]) {
      sets.push_back(a);
    }
  }
  return sets;
}

}  // namespace

Set without_map(Set set) {
  const Set free = (set & kFree) != 0 ? kFree : 0;
  const Set standing = (set & kStanding) != 0 ? kStanding : 0;
  return free | standing | (set & kMoving);
}

MassFunction without_map(const MassFunction& mass) {
  MassFunction lumped = MassFunction::empty(kPerceptionElements);
  for (Set a = 1; a <= kAnything; ++a) {
    lumped[without_map(a)] += mass[a];
  }
  return lumped;
}

MassFunction some_scan_with(Set map_classes) {
  const MassFunction source = source_evidence(0.4, 0.4);
  return map_classes == 0 ? source : dempster(source, map_evidence(map_classes, 0.97));
}

std::vector<Set> grid_sets(Set map_classes, const ScanParameters& parameters) {
  const MassFunction scan = some_scan_with(map_classes);
  const std::array<Operation, 3> operations{
      [=](const MassFunction& mass) { return aged(mass, parameters); },
      [=](const MassFunction& mass) { return fused_in_time(mass, scan).mass; },
      [=](const MassFunction& mass) { return specialised(mass, 0.5, parameters.which); }};
  return sets_in(closure(kPerceptionElements, operations));
}

bool commutes_with_the_scan(Set set, Set map_classes) {
  const std::vector<Set> said = sets_in(focal_sets(some_scan_with(map_classes)));
  return std::all_of(said.begin(), said.end(), [&](Set b) {
    const TemporalFusion with = fused_in_time(certain_of(set), certain_of(b));
    const TemporalFusion without =
        fused_in_time(certain_of(without_map(set)), certain_of(without_map(b)));
    return largest_difference(without_map(with.mass), without_map(without.mass)) == 0 &&
           with.conflict() == without.conflict() &&
           occupied_mass(with.mass) == occupied_mass(without.mass);
  });
}

bool commutes_with_specialisation(Set set, Specialised which) {
  return largest_difference(without_map(specialised(certain_of(set), 0.5, which)),
                            without_map(specialised(certain_of(without_map(set)), 0.5, which))) ==
         0;
}

bool commutes_with_ageing(Set set, const ScanParameters& parameters) {
  return largest_difference(without_map(aged(certain_of(set), parameters)),
                            without_map(aged(certain_of(without_map(set)), parameters))) < 1e-15;
}

double sensor_part_difference(const PerceptionCell& one, const PerceptionCell& other) {
  return std::max({std::abs(free_mass(one.mass) - free_mass(other.mass)),
                   std::abs(occupied_mass(one.mass) - occupied_mass(other.mass)),
                   std::abs(one.mass[kMoving] - other.mass[kMoving]),
                   std::abs(one.accumulator - other.accumulator)});
}

}  // namespace iog::lab::reference::evidential
