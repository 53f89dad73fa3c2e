// The thesis's perception cell by hand, and its section 5.4: the object that comes, stays and
// leaves (figure 5.6).
#include "lab/reference/evidential/perception.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "lab/reference/evidential/random_mass.hpp"

namespace iog::lab::reference::evidential {
namespace {

using tests::random_mass;

constexpr Set kStoppedOrMoving = kStopped | kMoving;

// Equations 4.1 and 4.2.
TEST(SourceEvidence, IsOfFreeAndOccupiedSets) {
  const MassFunction mass = source_evidence(0.25, 0.5);
  EXPECT_EQ(mass[kDrivable | kNonDrivable], 0.25);
  EXPECT_EQ(mass[kMapped | kMoving | kStopped | kUnmapped], 0.5);
  EXPECT_EQ(mass[kAnything], 0.25);
}

// Equations 4.3 and 4.4; borders are unions. Where all three classes are possible the map says
// nothing.
TEST(MapEvidence, NamesWhatMayBeInACell) {
  EXPECT_EQ(map_evidence(kBuilding, 0.75)[kMapped], 0.75);
  EXPECT_EQ(map_evidence(kRoad, 0.75)[kDrivable | kStopped | kMoving], 0.75);
  EXPECT_EQ(map_evidence(kIntermediate, 0.75)[kNonDrivable | kUnmapped | kStopped | kMoving], 0.75);
  EXPECT_EQ(map_evidence(kRoad | kIntermediate, 0.75)[kAnything & ~kMapped], 0.75);
  EXPECT_EQ(map_evidence(kRoad, 0.75)[kAnything], 0.25);
  EXPECT_EQ(map_evidence(kBuilding | kRoad | kIntermediate, 0.75)[kAnything], 1);
}

// Equations 5.4 and 5.9.
TEST(FusionInTime, NamesConflictByWhatCameFirst) {
  const TemporalFusion came = fused_in_time(source_evidence(0.5, 0), source_evidence(0, 0.5));
  EXPECT_EQ(came.appeared, 0.25);
  EXPECT_EQ(came.conflict(), 0.25);
  EXPECT_EQ(came.mass[kMoving], 0.25);
  EXPECT_EQ(came.mass[kFree], 0.25);
  EXPECT_EQ(came.mass[kOccupied], 0.25);
  EXPECT_EQ(came.mass[kAnything], 0.25);
  const TemporalFusion left = fused_in_time(source_evidence(0, 0.5), source_evidence(0.5, 0));
  EXPECT_EQ(left.disappeared, 0.25);
  EXPECT_EQ(left.conflict(), 0.25);
  EXPECT_EQ(left.mass[kMoving], 0);
  EXPECT_EQ(left.mass[kAnything], 0.5);
}

// What moves where the map has a building is neither appearance nor disappearance.
TEST(FusionInTime, LeavesOtherConflictToIgnorance) {
  const MassFunction moving(kPerceptionElements, {{kMoving, 1}});
  const TemporalFusion fusion = fused_in_time(moving, map_evidence(kBuilding, 0.75));
  EXPECT_EQ(fusion.other, 0.75);
  EXPECT_EQ(fusion.mass[kMoving], 0.25);
  EXPECT_EQ(fusion.mass[kAnything], 0.75);
}

// Equation 5.4 in its own words, on masses of all sets.
TEST(FusionInTime, HasTheConflictOfTheSums) {
  tests::Random random(54);
  for (int round = 0; round < 50; ++round) {
    const MassFunction before = random_mass(random, kPerceptionElements);
    const MassFunction now = random_mass(random, kPerceptionElements);
    const TemporalFusion fusion = fused_in_time(before, now);
    EXPECT_NEAR(fusion.appeared, free_mass(before) * occupied_mass(now), 1e-14);
    EXPECT_NEAR(fusion.disappeared, occupied_mass(before) * free_mass(now), 1e-14);
    EXPECT_NEAR(fusion.conflict(), conjunctive(before, now)[0], 1e-14);
    EXPECT_NEAR(fusion.mass.total(), 1, 1e-14);
  }
}

// Equation 5.9 writes Dempster's rule, which has shared out the conflict already.
TEST(FusionInTime, WouldCountConflictTwiceAsPrinted) {
  const MassFunction before = source_evidence(0.9, 0);
  const MassFunction now = source_evidence(0, 0.8);
  const double conflict = fused_in_time(before, now).conflict();
  EXPECT_NEAR(dempster(before, now).total() + conflict, 1.72, 1e-15);
  EXPECT_NEAR(fused_in_time(before, now).mass.total(), 1, 1e-15);
}

// Equations 5.5 and 5.6.
TEST(Accumulator, RisesWithOccupancyAndFallsFaster) {
  const TemporalFusion occupied{.mass = source_evidence(0, 0.75)};
  EXPECT_NEAR(accumulated(0.5, occupied, 0.1, 2), 0.5 + 0.1 * (0.75 - 2 * 0.25), 1e-15);
  const TemporalFusion in_conflict{.mass = source_evidence(0, 0.75), .disappeared = 0.5};
  EXPECT_NEAR(accumulated(0.5, in_conflict, 0.1, 2), 0.5 + 0.1 * (0.375 - 0.5), 1e-15);
  EXPECT_EQ(accumulated(0.05, TemporalFusion{}, 0.1, 6), 0);
  EXPECT_EQ(accumulated(0.95, {.mass = source_evidence(0, 1)}, 0.1, 6), 1);
}

// Equation 5.8 to the letter, and of occupied sets alone.
TEST(Specialisation, TakesMovingOutOfASet) {
  const MassFunction mass(kPerceptionElements,
                          {{kMoving, 0.25}, {kStoppedOrMoving, 0.25}, {kFree | kMoving, 0.25}});
  const MassFunction every = specialised(mass, 0.5, Specialised::kEverySet);
  EXPECT_EQ(every[kMoving], 0.125);
  EXPECT_EQ(every[kStoppedOrMoving], 0.125);
  EXPECT_EQ(every[kStopped], 0.125);
  EXPECT_EQ(every[kFree], 0.125);
  EXPECT_EQ(every[kAnything], 0.125 + 0.125);  // what is left of it, and what {M} lost
  EXPECT_EQ(every[kAnything & ~kMoving], 0.125);
  const MassFunction occupied = specialised(mass, 0.5, Specialised::kOccupiedSets);
  EXPECT_EQ(occupied[kMoving], 0.125);
  EXPECT_EQ(occupied[kStopped], 0.125);
  EXPECT_EQ(occupied[kFree | kMoving], 0.25);
  EXPECT_EQ(occupied[kAnything], 0.375);
}

// Section 5.4: free in scans 1 to 5, occupied to 24, then free; road, and the map in every scan.
struct RoadCell {
  PerceptionCell cell{};
  ScanParameters parameters{};
  int scans = 0;

  void scan() {
    ++scans;
    const bool is_occupied = scans >= 6 && scans <= 24;
    const MassFunction source = is_occupied ? source_evidence(0, 0.8) : source_evidence(0.7, 0);
    cell.scan(dempster(source, map_evidence(kRoad, 0.98)), parameters);
  }
};

struct Figure56Row {
  int scan;
  std::array<double, 6> values;  // D, M, {S, M}, S, Omega, zeta
};

// Computed once by a program of its own from the equations.
constexpr std::array<Figure56Row, 12> kFigure56{{
    {1, {0.686000, 0.000000, 0.000000, 0.000000, 0.006000, 0.000000}},
    {5, {0.956089, 0.000000, 0.000000, 0.000000, 0.000606, 0.000000}},
    {6, {0.172350, 0.689420, 0.108965, 0.000000, 0.000404, 0.000000}},
    {8, {0.005584, 0.634398, 0.265658, 0.022709, 0.042099, 0.061615}},
    {10, {0.000181, 0.402680, 0.373315, 0.121736, 0.064475, 0.137061}},
    {12, {0.000006, 0.212297, 0.380234, 0.313097, 0.057592, 0.212080}},
    {16, {0.000000, 0.030647, 0.164627, 0.767719, 0.018766, 0.377679}},
    {24, {0.000000, 0.000008, 0.003151, 0.993968, 0.000034, 0.761446}},
    {25, {0.008941, 0.000001, 0.000380, 0.295722, 0.307586, 0.554854}},
    {26, {0.487544, 0.000000, 0.000073, 0.087858, 0.148273, 0.284728}},
    {27, {0.769206, 0.000000, 0.000019, 0.026094, 0.062299, 0.000000}},
    {30, {0.949374, 0.000000, 0.000000, 0.000684, 0.002231, 0.000000}},
}};

TEST(Figure56, IsAnObjectThatComesStaysAndLeaves) {
  RoadCell road{.parameters = {.gain = 0.05}};
  for (const auto& [scan, values] : kFigure56) {
    while (road.scans < scan) {
      road.scan();
    }
    const MassFunction& mass = road.cell.mass;
    EXPECT_NEAR(mass[kDrivable], values[0], 1e-6) << "scan " << scan;
    EXPECT_NEAR(mass[kMoving], values[1], 1e-6) << "scan " << scan;
    EXPECT_NEAR(mass[kStoppedOrMoving], values[2], 1e-6) << "scan " << scan;
    EXPECT_NEAR(mass[kStopped], values[3], 1e-6) << "scan " << scan;
    EXPECT_NEAR(mass[kAnything], values[4], 1e-6) << "scan " << scan;
    EXPECT_NEAR(road.cell.accumulator, values[5], 1e-6) << "scan " << scan;
  }
}

// The first scan from the sixth on in which "stopped" has more than "moving".
int scan_of_stopping(ScanParameters parameters, double gain) {
  parameters.gain = gain;
  RoadCell road{.parameters = parameters};
  while (road.scans < 24) {
    road.scan();
    if (road.scans >= 6 && road.cell.mass[kStopped] > road.cell.mass[kMoving]) {
      return road.scans;
    }
  }
  return 0;
}

// "This happens at iteration 12 and 10 respectively when delta = 0.05 and delta = 0.15."
TEST(Figure56, StopsInScans12And10) {
  for (const Ageing ageing :
       {Ageing::kConservative, Ageing::kClassical, Ageing::kOptimistic, Ageing::kProportional}) {
    EXPECT_EQ(scan_of_stopping({.ageing = ageing}, 0.05), 12);
    EXPECT_EQ(scan_of_stopping({.ageing = ageing}, 0.15), 10);
  }
  EXPECT_EQ(scan_of_stopping({.ageing = Ageing::kContextual}, 0.05), 11);
  EXPECT_EQ(scan_of_stopping({.ageing = Ageing::kContextual}, 0.15), 10);
}

// Table 7.1's rates taken as they stand, without exchanging them.
TEST(Figure56, IsNotOfTheRatesOfTable71) {
  for (const auto& [ageing, scan] : {std::pair{Ageing::kConservative, 14},
                                     {Ageing::kClassical, 13},
                                     {Ageing::kOptimistic, 13},
                                     {Ageing::kProportional, 14}}) {
    const ScanParameters unexchanged{.ageing = ageing, .dynamic_loss = 0.01, .static_loss = 0.10};
    EXPECT_EQ(scan_of_stopping(unexchanged, 0.05), scan);
    EXPECT_EQ(scan_of_stopping(unexchanged, 0.15), 11);
  }
}

// The thresholds of section 8.2: 0.5, and for stopped 0.35.
TEST(PignisticDecision, HasALowerThresholdForStopped) {
  const auto decision = [](Set set, double mass) {
    return pignistic_decision(MassFunction(kPerceptionElements, {{set, mass}}));
  };
  EXPECT_EQ(decision(kStopped, 0.25), kStopped);  // 0.25 + 0.75 / 6
  EXPECT_EQ(decision(kStopped, 0.20), Set{0});
  EXPECT_EQ(decision(kMoving, 0.35), Set{0});
  EXPECT_EQ(decision(kMoving, 0.45), kMoving);
  EXPECT_EQ(decision(kStoppedOrMoving, 0.90), kStopped);  // 0.467 both
}

}  // namespace
}  // namespace iog::lab::reference::evidential
