// What a cell knows of free, occupied and moving is the same whether the map is fused into every
// scan or not: shown set by set, and run. That is why a cell need not know the map.
#include "lab/reference/evidential/sensor_part.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "lab/reference/evidential/random_mass.hpp"

namespace iog::lab::reference::evidential {
namespace {

using tests::Random;
using tests::random_share;

constexpr std::array kMaps{kRoad, kIntermediate, kRoad | kIntermediate};
constexpr std::array kAgeings{Ageing::kClassical, Ageing::kConservative, Ageing::kOptimistic,
                              Ageing::kContextual};
constexpr std::array kSpecialisations{Specialised::kEverySet, Specialised::kOccupiedSets};

TEST(SensorPart, IsKeptByAllThatIsDoneToAnySet) {
  for (const Ageing ageing : kAgeings) {
    for (const Specialised which : kSpecialisations) {
      const ScanParameters parameters{.ageing = ageing, .which = which};
      for (const Set map_class : kMaps) {
        for (const Set set : grid_sets(map_class, parameters)) {
          EXPECT_TRUE(commutes_with_the_scan(set, map_class)) << map_class << ": set " << set;
          EXPECT_TRUE(commutes_with_specialisation(set, which)) << map_class << ": set " << set;
          EXPECT_TRUE(commutes_with_ageing(set, parameters)) << map_class << ": set " << set;
        }
      }
    }
  }
}

// {M, S} of a road is half dynamic, {I, M, S, U} a quarter.
TEST(SensorPart, IsNotKeptByProportionalDiscounting) {
  const ScanParameters proportional{.ageing = Ageing::kProportional};
  EXPECT_FALSE(commutes_with_ageing(kMoving | kStopped, proportional));
  EXPECT_TRUE(commutes_with_ageing(kDrivable, proportional));
}

// The map adds nothing to what a scan says of the sensor part, but in a building: that is mapped
// infrastructure, so that it neither moves nor is free.
TEST(SensorPart, OfAScanIsTheSensors) {
  const MassFunction sensor = source_evidence(0.4, 0.4);
  for (const Set map_class : kMaps) {
    EXPECT_LT(tests::largest_difference(without_map(some_scan_with(map_class)), sensor), 1e-15);
  }
  EXPECT_GT(without_map(some_scan_with(kBuilding))[kStanding], 0.5);
}

// Phases of a cell that is free, occupied, unseen or seen both ways; random masses and rates. The
// same scans once with the map in each of them and once without.
double worst_difference(Set map_class, Ageing ageing, Specialised which, Random& random) {
  PerceptionCell with_map;
  PerceptionCell without;
  const double beta = random.one_in(2) ? 0.97 : random_share(random);
  double worst = 0;
  for (int scan = 0, phase = 0; scan < 200; ++scan) {
    phase = random.one_in(12) ? random.between(0, 3) : phase;
    const double free = phase == 1 || phase == 2 ? 0 : random_share(random) * 0.9;
    const double occupied = phase >= 2 ? random_share(random) * (0.95 - free) : 0;
    const ScanParameters parameters{.ageing = ageing,
                                    .dynamic_loss = random_share(random) * 0.3,
                                    .static_loss = random_share(random) * 0.1,
                                    .gain = random_share(random) * 0.2,
                                    .decline = 6 * random_share(random),
                                    .specialised_share = random_share(random),
                                    .which = which};
    const MassFunction source = source_evidence(free, occupied);
    with_map.scan(dempster(source, map_evidence(map_class, beta)), parameters);
    without.scan(source, parameters);
    worst = std::max(worst, sensor_part_difference(with_map, without));
  }
  return worst;
}

double worst_of_rounds(Set map_class, Ageing ageing, Specialised which) {
  Random random(map_class);
  double worst = 0;
  for (int round = 0; round < 5; ++round) {
    worst = std::max(worst, worst_difference(map_class, ageing, which, random));
  }
  return worst;
}

// On roads, in intermediate space and at their borders the map changes names alone.
TEST(SensorPart, IsTheSameWithAndWithoutMap) {
  for (const Specialised which : {Specialised::kEverySet, Specialised::kOccupiedSets}) {
    for (const Set map_class : {kRoad, kIntermediate, kRoad | kIntermediate}) {
      for (const Ageing ageing :
           {Ageing::kClassical, Ageing::kConservative, Ageing::kOptimistic, Ageing::kContextual}) {
        EXPECT_LT(worst_of_rounds(map_class, ageing, which), 1e-12)
            << "map " << map_class << ", ageing " << static_cast<int>(ageing);
      }
    }
  }
}

// A set's share in the dynamic classes changes when the map takes classes out of the set.
TEST(SensorPart, DependsOnTheMapIfDiscountingIsProportional) {
  for (const Set map_class : {kRoad, kIntermediate}) {
    EXPECT_GT(worst_of_rounds(map_class, Ageing::kProportional, Specialised::kOccupiedSets), 0.01);
  }
}

// A building rules out everything free and all that moves: there the thesis's map overrules.
TEST(SensorPart, DependsOnTheMapInABuilding) {
  EXPECT_GT(worst_of_rounds(kBuilding, Ageing::kConservative, Specialised::kOccupiedSets), 0.1);
}

}  // namespace
}  // namespace iog::lab::reference::evidential
