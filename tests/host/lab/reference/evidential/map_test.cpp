// What the map does in the thesis, where it is fused into every scan, and what it does when it
// speaks once, at the decision.
#include <array>
#include <gtest/gtest.h>

#include "lab/reference/evidential/perception.hpp"

namespace iog::lab::reference::evidential {
namespace {

double free_probability(const MassFunction& mass) { return pignistic(mass, kFree); }

// Pignistic probabilities of D, N, I, M, S, U by mask, beta 0.97. For road by hand: Dempster leaves
// F 0.1 (0.97 of it D), O 0.2 (0.97 {M, S}), M 0.05, K 0.55 (0.97 S) and Omega 0.1 (0.97 {D, M,
// S}).
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

}  // namespace
}  // namespace iog::lab::reference::evidential
