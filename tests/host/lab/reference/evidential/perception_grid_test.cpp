// The thesis's grid: cell by cell what its cells are alone.
#include "lab/reference/evidential/perception_grid.hpp"

#include <array>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "lab/reference/evidential/random_mass.hpp"

namespace iog::lab::reference::evidential {
namespace {

using tests::largest_difference;
using tests::Random;
using tests::random_share;

constexpr std::array kMaps{kRoad, kIntermediate, kBuilding, kRoad | kBuilding, kRoad};
constexpr double kBelief = 0.97;

// Some cells are seen from the beginning, some later, the last one never.
std::vector<SourceMass> random_sources(Random& random, int scan) {
  std::vector<SourceMass> sources(kMaps.size());
  for (std::size_t i = 0; i + 1 < sources.size(); ++i) {
    if (scan >= 3 * static_cast<int>(i) && random.one_in(2)) {
      (random.one_in(2) ? sources[i].free : sources[i].occupied) = 0.9 * random_share(random);
    }
  }
  return sources;
}

MassFunction scan_of(const SourceMass& source, Set map, bool in_every_scan) {
  const MassFunction evidence = source_evidence(source.free, source.occupied);
  return in_every_scan ? dempster(evidence, map_evidence(map, kBelief)) : evidence;
}

void expect_cells_alone(MapOrder order) {
  PerceptionGrid grid(kMaps, order, kBelief, {});
  std::array<PerceptionCell, kMaps.size()> cells;
  Random random(7);
  for (int scan = 0; scan < 40; ++scan) {
    const std::vector<SourceMass> sources = random_sources(random, scan);
    grid.scan(sources);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i].scan(scan_of(sources[i], kMaps[i], order == MapOrder::kEveryScan), {});
      ASSERT_LT(largest_difference(grid.cell(i).mass, cells[i].mass), 1e-14) << scan << ", " << i;
      ASSERT_NEAR(grid.cell(i).accumulator, cells[i].accumulator, 1e-14) << scan << ", " << i;
    }
  }
}

TEST(PerceptionGrid, IsItsCellsWithTheMapInEveryScan) { expect_cells_alone(MapOrder::kEveryScan); }

TEST(PerceptionGrid, IsItsCellsWithoutAMap) {
  expect_cells_alone(MapOrder::kNever);
  expect_cells_alone(MapOrder::kAtDecision);
}

TEST(PerceptionGrid, SaysItsMassWithTheMapAtTheDecision) {
  PerceptionGrid late(kMaps, MapOrder::kAtDecision, kBelief, {});
  PerceptionGrid never(kMaps, MapOrder::kNever, kBelief, {});
  const std::vector<SourceMass> sources(kMaps.size(), {.free = 0.6, .occupied = 0.1});
  late.scan(sources);
  never.scan(sources);
  for (std::size_t i = 0; i < kMaps.size(); ++i) {
    const MassFunction named = dempster(never.said(i), map_evidence(kMaps[i], kBelief));
    EXPECT_LT(largest_difference(late.said(i), named), 1e-15);
    EXPECT_EQ(largest_difference(late.cell(i).mass, never.cell(i).mass), 0);
  }
}

TEST(PerceptionGrid, ThatHasNothingButConflictIsVacuous) {
  PerceptionGrid grid(std::array{kRoad}, MapOrder::kNever, 0,
                      {.rule = TemporalRule::kConjunctive, .dynamic_loss = 0, .static_loss = 0});
  grid.scan(std::array{SourceMass{.free = 1}});
  grid.scan(std::array{SourceMass{.occupied = 1}});
  EXPECT_EQ(grid.cell(0).mass[0], 1);
  EXPECT_EQ(grid.said(0)[kAnything], 1);
}

// Section 3.5 on one free cell that is hit.
TEST(TemporalRules, PlaceTheConflictOfAHit) {
  const MassFunction before = source_evidence(0.5, 0);
  const MassFunction now = source_evidence(0, 0.5);
  const auto fused = [&](TemporalRule rule) { return fused_in_time(before, now, rule).mass; };
  EXPECT_EQ(fused(TemporalRule::kThesis)[kMoving], 0.25);
  EXPECT_EQ(fused(TemporalRule::kConjunctive)[0], 0.25);
  EXPECT_EQ(fused(TemporalRule::kYager)[kAnything], 0.5);
  EXPECT_NEAR(fused(TemporalRule::kDempster)[kFree], 1.0 / 3, 1e-15);
  EXPECT_EQ(fused(TemporalRule::kDisjunctive)[kAnything], 1);
}

TEST(TemporalRules, AreThoseOfSection35) {
  Random random(35);
  for (int round = 0; round < 20; ++round) {
    const MassFunction before = tests::random_mass(random, kPerceptionElements);
    const MassFunction now = tests::random_mass(random, kPerceptionElements);
    const auto difference = [&](TemporalRule rule, const MassFunction& expected) {
      return largest_difference(fused_in_time(before, now, rule).mass, expected);
    };
    EXPECT_LT(difference(TemporalRule::kConjunctive, conjunctive(before, now)), 1e-15);
    EXPECT_LT(difference(TemporalRule::kDempster, dempster(before, now)), 1e-15);
    EXPECT_LT(difference(TemporalRule::kYager, yager(before, now)), 1e-14);
    EXPECT_LT(difference(TemporalRule::kDisjunctive, disjunctive(before, now)), 1e-15);
  }
}

}  // namespace
}  // namespace iog::lab::reference::evidential
