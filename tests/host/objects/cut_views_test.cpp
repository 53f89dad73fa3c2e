// A spinning lidar whose frames cover 144 degrees: the end of a frame cuts what is there in every
// other turn.
#include "objects/cut_views.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "objects/drawn_scene.hpp"

namespace iog::objects::tests {
namespace {

// Frames end 36, 108 and 180 degrees from the front; or, if the first one begins 36 degrees from
// the rear, 0, 72 and 144 degrees from it.
Scene scene_in_parts(Motion car, Thing thing, double begins_at) {
  Scene scene(std::move(car), {std::move(thing)});
  scene.lag_us = 200'000;
  scene.turns_of_a_frame = 0.4;
  scene.begins_at = begins_at;
  return scene;
}

// It keeps 12 m ahead. Neither half of its rear is a car that swerves: its velocity is known as
// well as if no frame ended there, to a cell in a third of a second.
TEST(CutViews, ACarAheadKeepsItsSpeedWhereverFramesEnd) {
  for (const double begins_at : {0.0, 0.1}) {
    for (const double speed : {2.5, 4.0}) {
      const auto tracker = std::make_unique<Tracker>();
      Scene scene =
          scene_in_parts(straight({}, speed), {.middle = straight({.x = 12}, speed)}, begins_at);
      scene.show_until(2, *tracker);
      scene.show_until(6, *tracker, [&] {
        if (const Track* track = scene.track_of(0, *tracker)) {
          EXPECT_TRUE(track->moves()) << begins_at << " at " << scene.now_s();
          EXPECT_LT(std::hypot(track->velocity().x * 1e-3 - speed, track->velocity().y * 1e-3), 0.3)
              << begins_at << " at " << scene.now_s();
        }
      });
    }
  }
}

// A car stands across the view, 8 m ahead of ours: its halves do not move, and they are one car.
TEST(CutViews, ACarThatStandsIsOne) {
  const auto tracker = std::make_unique<Tracker>();
  Scene scene = scene_in_parts(at_rest({}), {.middle = at_rest({.x = 8, .heading = 1.57})}, 0.1);
  scene.show_until(4, *tracker,
                   [&] { EXPECT_EQ(scene.moving_share(0, *tracker), 0) << scene.now_s(); });
}

// Frames of one slice: nothing is cut, however many views follow each other.
TEST(CutViews, AFrameOfOneSliceHasNoParts) {
  CutViews cut;
  std::array<FrameHit, 2> hits{};
  const std::array<std::uint16_t, 2> numbers{0, 1};
  Track track;
  track.begin(1, {.sides = {Interval{0, 1'000}, Interval{0, 1'000}}}, kStartUs);
  for (int frame = 0; frame < 3; ++frame) {
    cut.begin(std::array<std::uint8_t, 1>{0}, Step(40));
    hits[0].owner = hits[1].owner = 0;
    EXPECT_EQ(cut.join(0, {}, {numbers, hits}, track).numbers.size(), 2U);
    cut.keep({}, hits);
  }
}

// Two slices, 32 and 0 ms old. The newest of one frame and the oldest of the next are one view; the
// track is as before the first of them, and its older hits have moved on for 40 ms more. Not if
// there was a frame between them, nor if the track in the slot is another one.
TEST(CutViews, PartsInSuccessiveFramesAreOneView) {
  struct Case {
    std::int32_t step_ms;
    std::uint32_t next_id;
    std::size_t hits;
  };
  for (const Case its : {Case{40, 1, 3}, {80, 1, 1}, {40, 2, 1}}) {
    CutViews cut;
    constexpr std::array<std::uint8_t, 2> kAges{0, 32};
    std::array<FrameHit, 2> first{};
    std::array<FrameHit, 1> second{};
    first[0].owner = first[1].owner = second[0].owner = 0;
    second[0].age_ms = 32;
    Track track;
    track.begin(1, {.sides = {Interval{0, 1'000}, Interval{0, 1'000}}}, kStartUs);
    track.correct(kAlong, {.place = 0, .speed = 1 << 16}, 1'000);
    cut.begin(kAges, Step(40));
    constexpr std::array<std::uint16_t, 2> kTwo{0, 1};
    EXPECT_EQ(cut.join(0, {}, {kTwo, first}, track).numbers.size(), 2U);
    track.confidence = 7;  // by the first part
    cut.keep({}, first);
    track.id = its.next_id;
    cut.begin(kAges, Step(its.step_ms));
    constexpr std::array<std::uint16_t, 1> kOne{0};
    const View view = cut.join(0, {}, {kOne, second}, track);
    ASSERT_EQ(view.numbers.size(), its.hits);
    EXPECT_EQ(track.confidence, its.hits == 3 ? 0 : 7);
    if (its.hits == 3) {
      EXPECT_EQ(view.hits[view.numbers[1]].age_ms, 40);
      EXPECT_EQ(view.hits[view.numbers[1]].moved.x_mm, first[0].at().x_mm + 40);
      view.hits[view.numbers[0]].owner = kNobody;
      cut.give_back(0, {kOne, second});
      EXPECT_EQ(second[0].owner, kNobody);
    }
  }
}

// The other track is gone, so what the older one has become stays.
TEST(CutViews, ATrackThatHasTakenOverAnotherStays) {
  CutViews cut;
  constexpr std::array<std::uint8_t, 2> kAges{0, 32};
  std::array<FrameHit, 1> first{};
  std::array<FrameHit, 1> second{};
  first[0].owner = second[0].owner = 0;
  second[0].age_ms = 32;
  std::array<Track, 1> tracks{};
  Track& track = tracks[0];
  track.begin(1, {.sides = {Interval{0, 1'000}, Interval{0, 1'000}}}, kStartUs);
  constexpr std::array<std::uint16_t, 1> kOne{0};
  cut.begin(kAges, Step(40));
  EXPECT_EQ(cut.join(0, {}, {kOne, first}, track).numbers.size(), 1U);
  track.sides()[kAlong].high = 4'000;
  track.seen.has_merged = true;
  cut.keep(tracks, first);
  cut.begin(kAges, Step(40));
  EXPECT_EQ(cut.join(0, {}, {kOne, second}, track).numbers.size(), 1U);
  EXPECT_EQ(track.box().sides[kAlong].high, 4'000);
}

// A frame of a whole turn begins and ends in an object. Its older hits are measured, with the newer
// ones of the frame before; nothing is undone.
TEST(CutViews, AViewOfAWholeTurnHasOneSweep) {
  CutViews cut;
  constexpr std::array<std::uint8_t, 3> kAges{0, 48, 96};
  Track track;
  track.begin(1, {.sides = {Interval{0, 1'000}, Interval{0, 1'000}}}, kStartUs);
  constexpr std::array<std::uint16_t, 3> kThree{0, 1, 2};
  for (const std::size_t hits : {1U, 3U, 3U}) {
    std::array<FrameHit, 3> of_frame{};
    of_frame[0].age_ms = 96;
    for (FrameHit& hit : of_frame) {
      hit.owner = 0;
    }
    cut.begin(kAges, Step(100));
    const View view = cut.join(0, {}, {kThree, of_frame}, track);
    ASSERT_EQ(view.numbers.size(), hits);
    EXPECT_EQ(view.hits[view.numbers[0]].age_ms, 96);
    EXPECT_EQ(view.hits[view.numbers[hits - 1]].age_ms, hits == 1 ? 96 : 100);
    EXPECT_EQ(track.confidence, hits == 1 ? 0 : 7);
    track.confidence = 7;
    view.hits[view.numbers[0]].owner = kNobody;
    cut.give_back(0, {kThree, of_frame});
    EXPECT_EQ(of_frame[0].owner, kNobody);
    EXPECT_EQ(of_frame[1].owner, 0);
    cut.keep({}, of_frame);
  }
}

// What waits is not undone, so a track that has taken over another one keeps it.
TEST(CutViews, HitsWaitAcrossAMerge) {
  CutViews cut;
  constexpr std::array<std::uint8_t, 2> kAges{0, 96};
  constexpr std::array<std::uint16_t, 2> kTwo{0, 1};
  std::array<Track, 1> tracks{};
  tracks[0].begin(1, {.sides = {Interval{0, 1'000}, Interval{0, 1'000}}}, kStartUs);
  tracks[0].seen.has_merged = true;
  for (const std::size_t hits : {1U, 2U}) {
    std::array<FrameHit, 2> of_frame{};
    of_frame[0].owner = of_frame[1].owner = 0;
    of_frame[1].age_ms = 96;
    cut.begin(kAges, Step(100));
    EXPECT_EQ(cut.join(0, {}, {kTwo, of_frame}, tracks[0]).numbers.size(), hits);
    cut.keep(tracks, of_frame);
  }
}

// More than kMostCutHits hits cannot wait: such a view has two sweeps, and loses no hit.
TEST(CutViews, WhatCannotWaitIsMeasuredAtOnce) {
  constexpr std::array<std::uint8_t, 2> kAges{0, 96};
  for (const std::size_t newer : {kMostCutHits, kMostCutHits + 1}) {
    CutViews cut;
    Track track;
    track.begin(1, {.sides = {Interval{0, 1'000}, Interval{0, 1'000}}}, kStartUs);
    std::vector<FrameHit> hits(newer + 1);
    std::vector<std::uint16_t> numbers(hits.size());
    std::iota(numbers.begin(), numbers.end(), std::uint16_t{0});
    hits[newer].age_ms = 96;
    cut.begin(kAges, Step(100));
    EXPECT_EQ(cut.join(0, {}, {numbers, hits}, track).numbers.size(),
              newer == kMostCutHits ? 1U : hits.size());
  }
}

// With hits between them, the oldest and the newest are of one sweep over something long.
TEST(CutViews, AViewWithoutAGapIsWhole) {
  CutViews cut;
  constexpr std::array<std::uint8_t, 3> kAges{0, 48, 96};
  Track track;
  track.begin(1, {.sides = {Interval{0, 1'000}, Interval{0, 1'000}}}, kStartUs);
  std::array<FrameHit, 3> hits{};
  hits[1].age_ms = 48;
  hits[2].age_ms = 96;
  constexpr std::array<std::uint16_t, 3> kThree{0, 1, 2};
  cut.begin(kAges, Step(100));
  EXPECT_EQ(cut.join(0, {}, {kThree, hits}, track).numbers.size(), 3U);
}

}  // namespace
}  // namespace iog::objects::tests
