// What the map does in the thesis, where it is fused into every scan, and what is the same when it
// speaks once, at the decision.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "lab/reference/evidential/perception.hpp"
#include "lab/reference/evidential/random_mass.hpp"

namespace iog::lab::reference::evidential {
namespace {

using tests::Random;
using tests::random_share;

double free_probability(const MassFunction& mass) { return pignistic(mass, kFree); }

// Occupied by F 0.10, O 0.20, M 0.05, K 0.55: pignistic probabilities of D, N, I, M, S, U by mask,
// beta 0.97. For road by hand: Dempster leaves F 0.1 (0.97 of it D), O 0.2 (0.97 {M, S}), M 0.05, K
// 0.55 (0.97 S) and Omega 0.1 (0.97 {D, M, S}).
TEST(MapAtTheDecision, NamesWhatTheSensorLeavesOpen) {
  const MassFunction mass(
      kPerceptionElements,
      {{kFree, 0.10}, {kOccupied, 0.20}, {kMoving, 0.05}, {kStanding, 0.55}, {kAnything, 0.10}});
  constexpr std::array<std::array<double, 6>, 7> kExpected{{
      {0.002341, 0.002341, 0.973669, 0.004096, 0.008777, 0.008777},
      {0.131333, 0.002000, 0.007500, 0.181333, 0.670333, 0.007500},
      {0.123250, 0.002000, 0.363167, 0.140917, 0.363167, 0.007500},
      {0.002000, 0.123250, 0.007500, 0.140917, 0.363167, 0.363167},
      {0.002000, 0.118400, 0.253233, 0.119900, 0.253233, 0.253233},
      {0.069900, 0.069900, 0.007500, 0.136067, 0.358317, 0.358317},
      {0.066667, 0.066667, 0.250000, 0.116667, 0.250000, 0.250000},
  }};
  for (Set mask = 1; mask <= 7; ++mask) {
    const MassFunction named = dempster(mass, map_evidence(mask, 0.97));
    for (std::size_t element = 0; element < 6; ++element) {
      EXPECT_NEAR(pignistic(named, Set{1} << element), kExpected[mask - 1][element], 1e-6)
          << "mask " << mask << ", element " << element;
    }
  }
  EXPECT_EQ(pignistic_decision(dempster(mass, map_evidence(kRoad, 0.97))), kStopped);
  EXPECT_EQ(pignistic_decision(dempster(mass, map_evidence(kBuilding, 0.97))), kMapped);
}

struct Belief {
  int scans;
  double mapped;  // betP({I})
  double free;    // betP({D, N})
};

// A mapped building that does not exist, seen free in every scan of 10 Hz. Delta is that of
// equation 7.4 at 10 Hz.
void expect_beliefs(double beta, bool in_every_scan, const std::array<Belief, 5>& expected) {
  const MassFunction map = map_evidence(kBuilding, beta);
  const MassFunction source = source_evidence(0.7, 0);
  PerceptionCell cell;
  int scans = 0;
  for (const Belief& belief : expected) {
    for (; scans < belief.scans; ++scans) {
      cell.scan(in_every_scan ? dempster(source, map) : source,
                {.gain = 1.0 / 30, .which = Specialised::kOccupiedSets});
    }
    const MassFunction said = in_every_scan ? cell.mass : dempster(cell.mass, map);
    EXPECT_NEAR(pignistic(said, kMapped), belief.mapped, 5e-5) << "scan " << scans;
    EXPECT_NEAR(free_probability(said), belief.free, 5e-5) << "scan " << scans;
  }
}

// A hundred scans do not bring down a building that the map repeats as often.
TEST(MappedBuildingThatIsNotThere, StandsForEverIfTheMapSpeaksInEveryScan) {
  expect_beliefs(0.97, true,
                 {{{1, 0.9112, 0.0748},
                   {2, 0.8885, 0.0288},
                   {5, 0.9328, 0.0278},
                   {10, 0.9355, 0.0275},
                   {100, 0.9390, 0.0277}}});
  expect_beliefs(0.99, true,
                 {{{1, 0.9691, 0.0261},
                   {2, 0.9608, 0.0089},
                   {5, 0.9791, 0.0085},
                   {10, 0.9796, 0.0084},
                   {100, 0.9800, 0.0084}}});
}

TEST(MappedBuildingThatIsNotThere, IsDoubtedIfTheMapSpeaksOnce) {
  expect_beliefs(0.97, false,
                 {{{1, 0.9112, 0.0748},
                   {2, 0.7861, 0.2018},
                   {5, 0.5816, 0.4094},
                   {10, 0.5735, 0.4176},
                   {100, 0.5735, 0.4176}}});
  expect_beliefs(0.99, false,
                 {{{1, 0.9691, 0.0261},
                   {2, 0.9181, 0.0772},
                   {5, 0.8092, 0.1867},
                   {10, 0.8041, 0.1919},
                   {100, 0.8041, 0.1919}}});
}

// One statement, taken for new evidence in every scan.
TEST(MapInEveryScan, AgreesWithItself) {
  const Set road_set = kDrivable | kStopped | kMoving;
  PerceptionCell cell;
  const auto after_one_more = [&] {
    cell.scan(map_evidence(kRoad, 0.97), {});
    return cell.mass[road_set];
  };
  EXPECT_NEAR(after_one_more(), 0.970000, 1e-6);
  EXPECT_NEAR(after_one_more(), 0.995928, 1e-6);
  EXPECT_NEAR(after_one_more(), 0.996621, 1e-6);
  for (int scan = 4; scan < 20; ++scan) {
    after_one_more();
  }
  EXPECT_NEAR(after_one_more(), 0.996640, 1e-6);
}

// What a cell knows of free, occupied, moving, and how long it has been occupied.
double sensor_part_difference(const PerceptionCell& one, const PerceptionCell& other) {
  return std::max({std::abs(free_mass(one.mass) - free_mass(other.mass)),
                   std::abs(occupied_mass(one.mass) - occupied_mass(other.mass)),
                   std::abs(one.mass[kMoving] - other.mass[kMoving]),
                   std::abs(one.accumulator - other.accumulator)});
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
  for (int round = 0; round < 20; ++round) {
    worst = std::max(worst, worst_difference(map_class, ageing, which, random));
  }
  return worst;
}

// On roads, in intermediate space and at their borders the map changes names alone: what the sensor
// says is the same with and without it. That is why a cell need not know the map.
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
