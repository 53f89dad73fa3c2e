#include "lab/reference/evidential/perception.hpp"

#include <algorithm>

#include "lab/reference/evidential/discounting.hpp"

namespace iog::lab::reference::evidential {
namespace {

double mass_within(const MassFunction& mass, Set set) {
  double sum = 0;
  for (const Set a : Focals(mass)) {
    sum += a != 0 && is_subset(a, set) ? mass[a] : 0;
  }
  return sum;
}

// The conflict of two sets that have nothing in common.
void add_conflict(TemporalFusion& fusion, Set before, Set now, double mass) {
  const auto is_part = [](Set set, Set of) { return set != 0 && is_subset(set, of); };
  if (is_part(before, kFree) && is_part(now, kOccupied)) {
    fusion.appeared += mass;
  } else if (is_part(before, kOccupied) && is_part(now, kFree)) {
    fusion.disappeared += mass;
  } else {
    fusion.other += mass;
  }
}

// Where the mass of the empty set goes.
void place_conflict(TemporalFusion& fusion, TemporalRule rule) {
  if (rule == TemporalRule::kConjunctive) {
    return;
  }
  if (rule == TemporalRule::kDempster) {
    fusion.mass = normalised(fusion.mass);
    return;
  }
  const bool is_thesis = rule == TemporalRule::kThesis;
  fusion.mass[0] = 0;
  fusion.mass[kMoving] += is_thesis ? fusion.appeared : 0;
  fusion.mass[kAnything] += fusion.disappeared + fusion.other + (is_thesis ? 0 : fusion.appeared);
}

}  // namespace

MassFunction source_evidence(double free, double occupied) {
  const MassFunction source(2, {{kSourceFree, free}, {kSourceOccupied, occupied}});
  return refined(source, kSourceImages, kPerceptionElements);
}

MassFunction map_evidence(Set map_classes, double beta) {
  return refined(MassFunction(3, {{map_classes, beta}}), kMapImages, kPerceptionElements);
}

double free_mass(const MassFunction& mass) { return mass_within(mass, kFree); }

double occupied_mass(const MassFunction& mass) { return mass_within(mass, kOccupied); }

TemporalFusion fused_in_time(const MassFunction& before, const MassFunction& now,
                             TemporalRule rule) {
  if (rule == TemporalRule::kDisjunctive) {
    return {.mass = disjunctive(before, now)};
  }
  TemporalFusion fusion{.mass = conjunctive(before, now)};
  const Focals of_now(now);
  for (const Set b : Focals(before)) {
    for (const Set c : of_now) {
      if ((b & c) == 0) {
        add_conflict(fusion, b, c, before[b] * now[c]);
      }
    }
  }
  place_conflict(fusion, rule);
  return fusion;
}

double accumulated(double accumulator, const TemporalFusion& fusion, double gain, double decline) {
  const double occupied = occupied_mass(fusion.mass);
  const double change = occupied * (1 - fusion.conflict()) - decline * (1 - occupied);
  return std::clamp(accumulator + gain * change, 0.0, 1.0);
}

MassFunction specialised(const MassFunction& mass, double share, Specialised which) {
  MassFunction special = mass;
  for (const Set a : Focals(mass)) {
    const bool counts = which == Specialised::kEverySet || is_subset(a, kOccupied);
    if ((a & kMoving) != 0 && counts) {
      special[a] -= mass[a] * share;
      special[a == kMoving ? kAnything : a & ~kMoving] += mass[a] * share;
    }
  }
  return special;
}

MassFunction aged(const MassFunction& mass, const ScanParameters& parameters) {
  const std::array rates{Rate{kDynamic, parameters.dynamic_loss},
                         Rate{kStatic, parameters.static_loss}};
  switch (parameters.ageing) {
    case Ageing::kContextual: {
      const std::array of_complement{Rate{kStatic, parameters.dynamic_loss},
                                     Rate{kDynamic, parameters.static_loss}};
      return discounted_contextually(mass, of_complement);
    }
    case Ageing::kConservative:
      return discounted(mass, Scheme::kConservative, rates);
    case Ageing::kOptimistic:
      return discounted(mass, Scheme::kOptimistic, rates);
    case Ageing::kProportional:
      return discounted(mass, Scheme::kProportional, rates);
    case Ageing::kClassical:
      break;
  }
  return discounted_classically(mass, parameters.dynamic_loss);
}

TemporalFusion PerceptionCell::scan(const MassFunction& sensor_grid,
                                    const ScanParameters& parameters) {
  TemporalFusion fusion = fused_in_time(aged(mass, parameters), sensor_grid, parameters.rule);
  accumulator = accumulated(accumulator, fusion, parameters.gain, parameters.decline);
  mass = specialised(fusion.mass, accumulator * parameters.specialised_share, parameters.which);
  return fusion;
}

Set pignistic_decision(const MassFunction& mass) {
  Set decision = 0;
  double most = 0;
  for (Set element = 1; element <= kUnmapped; element <<= 1) {
    const double probability = pignistic(mass, element);
    if (probability >= (element == kStopped ? 0.35 : 0.5) && probability > most) {
      decision = element;
      most = probability;
    }
  }
  return decision;
}

}  // namespace iog::lab::reference::evidential
