#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <set>

#include "gtest/gtest.h"

#include "lab/experiments/perception/perceived_drive.hpp"
#include "lab/experiments/perception/scores.hpp"
#include "lab/experiments/perception/street.hpp"
#include "lab/experiments/perception/truth.hpp"
#include "tools/simulate/scenes/street.hpp"

namespace iog::lab {
namespace {

constexpr std::array kOneRule{PerceptionRule{"default"}};

TEST(LocalToWorld, TurnsAndMovesAsThePoseIsOff) {
  // Placed at (1 m, 2 m), a quarter turn to the left; it truly was at (5 m, 7 m), without a turn.
  const LocalToWorld to_world({.x_mm = 1000, .y_mm = 2000, .heading = 1U << 30},
                              {.x = 5, .y = 7, .cos = 1, .sin = 0});
  // The cell's centre is 0.05 m beyond (1 m, 4 m) on each axis: 2.05 m ahead and 0.05 m to the
  // right of the placed car.
  const LocalToWorld::Point at = to_world.centre_of({10, 40});
  EXPECT_NEAR(at.x_m, 7.05, 1e-9);
  EXPECT_NEAR(at.y_m, 6.95, 1e-9);
  // What goes to the left of the local frame goes ahead in the world.
  EXPECT_NEAR(to_world.turned(0, 3).x_m, 3, 1e-9);
  EXPECT_NEAR(to_world.turned(0, 3).y_m, 0, 1e-9);
  EXPECT_EQ(to_world.car().x_m, 5);
  EXPECT_EQ(to_world.car().y_m, 7);
}

// Hits and joined indexes are found in two ways.
TEST(PerceivedDrive, HitsAreTheCellsWithPositiveEvidence) {
  const PerceivedDrive drive{.scene = "city", .seed = 5, .seconds = 1, .shown_every = 10};
  std::size_t shown = 0;
  perceive_drive(drive, kOneRule, [&shown](const PerceivedFrame& frame) {
    EXPECT_FALSE(frame.hits.empty());
    if (frame.classes.empty()) {
      return;
    }
    ++shown;
    std::set<std::size_t> places;
    for (const HitCell& hit : frame.hits) {
      places.insert(frame.window.place_of(hit.cell));
      EXPECT_GT(frame.evidence[frame.window.place_of(hit.cell)], 0);
    }
    EXPECT_EQ(std::ranges::count_if(frame.evidence, [](std::int8_t index) { return index > 0; }),
              static_cast<std::ptrdiff_t>(places.size()));
  });
  EXPECT_EQ(shown, 2U);
}

// The share of the hits of the last half second that are on something.
double share_on_things(const tools::PoseOptions& poses) {
  const PerceivedDrive drive{
      .scene = "city", .seed = 5, .seconds = 2, .poses = poses, .shown_every = 100};
  LocalToWorld to_world;
  std::size_t hits = 0;
  std::size_t on_things = 0;
  perceive_drive(drive, kOneRule, [&](const PerceivedFrame& frame) {
    const FrameTruth truth(frame, to_world);
    to_world = truth.last().to_world;
    for (const HitCell& hit : frame.hits) {
      const bool counts = frame.number >= 38;
      hits += counts ? 1U : 0U;
      on_things += counts && truth.near(hit).state != TrueState::kNothing ? 1U : 0U;
    }
  });
  return static_cast<double>(on_things) / static_cast<double>(hits);
}

// With a deviation of 0.1 m a range is within 0.2 m in 95 of 100 cases. The truth goes with the
// local frame when that jumps.
TEST(FrameTruth, FindsWhatWasHitWhereverTheLocalFrameIs) {
  EXPECT_GT(share_on_things({}), 0.95);
  tools::PoseOptions jump;
  jump.jumps = {{1.0, 3.0}};
  EXPECT_GT(share_on_things(jump), 0.95);
}

// The scores of one frame if its classes were these. paint: from a cell's evidence to its class.
template <typename Paint>
PerceptionScores scores_if(const Paint& paint) {
  const PerceivedDrive drive{.scene = "city", .seed = 5, .seconds = 1, .shown_every = 25};
  PerceptionScorer scorer(1, 0);
  LocalToWorld to_world;
  perceive_drive(drive, kOneRule, [&](const PerceivedFrame& frame) {
    PerceivedFrame painted = frame;
    for (auto& classes : painted.classes) {
      std::ranges::transform(frame.evidence, classes.begin(), paint);
    }
    const FrameTruth truth(frame, to_world);
    to_world = truth.last().to_world;
    scorer.add(painted, truth, !frame.classes.empty());
  });
  return scorer.scores().front();
}

// The scores of a drive in the city whose poses are these.
PerceptionScores scores_with(const tools::PoseOptions& poses) {
  const PerceivedDrive drive{.scene = "city", .seed = 5, .seconds = 4, .poses = poses};
  PerceptionScorer scorer(1, 0);
  LocalToWorld to_world;
  perceive_drive(drive, kOneRule, [&](const PerceivedFrame& frame) {
    const FrameTruth truth(frame, to_world);
    to_world = truth.last().to_world;
    scorer.add(frame, truth, !frame.classes.empty());
  });
  return scorer.scores().front();
}

// Poses that swing by less than a jump in each second are not found out. What stands survives them:
// where it has been hit lately, it is not free.
TEST(PerceivedDrive, WhatStandsSurvivesPosesThatSwing) {
  for (const tools::PoseOptions::Swing swing : {tools::PoseOptions::Swing{0.5, 0.28, 2},  //
                                                tools::PoseOptions::Swing{0.5, 0.7, 8}}) {
    const RecentHits::Kept recent = scores_with({.swings = {swing}}).recent;
    const std::uint64_t freed =
        std::accumulate(recent.freed.begin(), recent.freed.end(), std::uint64_t{0});
    EXPECT_GT(recent.all_cells(), 10'000U);
    EXPECT_LE(freed, recent.all_cells() / 200) << swing.metres;
  }
}

constexpr std::int8_t kMovingByte = 4 * 8;
constexpr std::int8_t kOpenByte = 8 * 8;

TEST(PerceptionScorer, CountsWhatTheClassesSay) {
  const PerceptionScores open = scores_if([](std::int8_t /*index*/) { return kOpenByte; });
  const PerceptionScores unknown = scores_if([](std::int8_t /*index*/) { return std::int8_t{0}; });
  EXPECT_GT(open.recent.all_cells(), 1000U);
  EXPECT_EQ(open.recent.all_kept(), open.recent.all_cells());
  EXPECT_EQ(open.gaps[0].unknown, 0U);
  EXPECT_EQ(unknown.recent.all_cells(), open.recent.all_cells());
  EXPECT_EQ(unknown.recent.all_kept(), 0U);
  EXPECT_EQ(unknown.gaps[0].between, 0U);
  for (std::size_t what = 0; what < kHitOnCount; ++what) {
    for (std::size_t range = 0; range < kRangeCount; ++range) {
      EXPECT_EQ(open.hits[what][range].open, unknown.hits[what][range].unknown);
      EXPECT_EQ(open.hits[what][range].all(), unknown.hits[what][range].all());
    }
  }
  EXPECT_EQ(open.moving.called, 0U);
}

TEST(PerceptionScorer, CallsMovingRightNearWhatMoves) {
  const PerceptionScores moving =
      scores_if([](std::int8_t index) { return index > 0 ? kMovingByte : std::int8_t{0}; });
  std::uint64_t hits = 0;
  std::uint64_t on_movers = 0;
  for (std::size_t what = 0; what < kHitOnCount; ++what) {
    for (const SaidCounts& said : moving.hits[what]) {
      EXPECT_EQ(said.all(), said.moving);
      hits += said.all();
      on_movers += what == 0 ? 0 : said.all();
    }
  }
  EXPECT_EQ(moving.moving.called, moving.moving.with_evidence);
  EXPECT_EQ(moving.moving.right, moving.moving.right_with_evidence);
  EXPECT_GT(moving.moving.right, 50U);
  EXPECT_LE(moving.moving.right, on_movers);  // two slices may hit one cell
  EXPECT_LT(moving.moving.right, hits / 2);
}

}  // namespace
}  // namespace iog::lab
