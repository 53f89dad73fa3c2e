// What a frame's hits change of a track: the rows of the table in docs/objects.md, "Measure".
#include "objects/measure.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace iog::objects {
namespace {

constexpr std::uint64_t kBornAtUs = 1'000'000'000;
constexpr double kBirthVariance = 100.0 * 100.0;
constexpr double kFaceVariance = 50.0 * 50.0 + 90.0 * 90.0;  // of one hit
constexpr double kEndVariance = 80.0 * 80.0;                 // nearer than a metre

// How far a track of 2 m by 2 m moves along x if its rear and its front are hit so much farther.
double moved_by(std::int32_t off_mm, Point car, std::uint32_t updates) {
  Track track;
  track.begin(1, {.at = {0, 0}, .sides = {Interval{0, 2'000}, Interval{0, 2'000}}}, kBornAtUs);
  track.updates = updates;
  std::array<FrameHit, 2> hits{};
  hits[0].moved = {off_mm, 0};
  hits[1].moved = {2'000 + off_mm, 2'000};
  constexpr std::array<std::uint16_t, 2> kNumbers{0, 1};
  measure(car, kBornAtUs + 40'000, Step(40), kNumbers, hits, track);
  EXPECT_EQ(track.updates, updates + 1);
  EXPECT_EQ(track.seen.hits, 2);
  return track.box().at.x_mm;
}

double share_of(double variance) { return kBirthVariance / (kBirthVariance + variance); }

// By its face from where the car is more than 300 mm behind it, by both of its ends from beside it.
TEST(Measure, AFaceIsSeenFromMoreThanThirtyCentimetresAway) {
  EXPECT_NEAR(moved_by(100, {-301, 1'000}, 1), 100 * share_of(kFaceVariance), 1);
  EXPECT_NEAR(moved_by(100, {-300, 1'000}, 1), 100 * share_of(kEndVariance), 1);
  EXPECT_NEAR(moved_by(100, {2'300, 1'000}, 1), 100 * share_of(kEndVariance), 1);
  EXPECT_NEAR(moved_by(100, {2'301, 1'000}, 1), 100 * share_of(kFaceVariance), 1);
}

// Of a track of 2 m by 2 m that moves along x, the far end of which is hit so much farther and the
// near one where it is, or so much less far.
struct Aslant {
  Point car;
  std::int32_t far_off_mm = 0;
  std::int32_t near_off_mm = 0;
  std::uint32_t updates = 6;
  State state = State::kMoves;
  bool has_heading = true;
};
Track measured(const Aslant& its) {
  Track track;
  const Sides sides{Interval{0, 2'000}, Interval{0, 2'000}};
  track.begin(1, {.at = {0, 0}, .sides = sides}, kBornAtUs);
  if (its.has_heading) {
    track.begin_heading(sides);
  }
  track.updates = its.updates;
  track.state = its.state;
  const bool is_before = its.car.x_mm > 0;
  std::array<FrameHit, 2> hits{};
  hits[0].moved = {is_before ? its.far_off_mm : its.near_off_mm, 0};
  hits[1].moved = {2'000 + (is_before ? its.near_off_mm : its.far_off_mm), 2'000};
  constexpr std::array<std::uint16_t, 2> kNumbers{0, 1};
  measure(its.car, kBornAtUs + 40'000, Step(40), kNumbers, hits, track);
  return track;
}
double moved(const Aslant& its) { return measured(its).box().at.x_mm; }

// "Beside it by more than a quarter of the way to its far end": that end counts, because the face
// may be where the view ends.
TEST(Measure, TheFarEndCountsOfASideThatIsSeen) {
  constexpr Point kAslant{-1'999, -1'000};
  constexpr Point kAhead{-2'000, -1'000};
  const auto by_end = [](double metres) {
    return 200 * share_of(kEndVariance + 9 * metres * 9 * metres / 4);
  };
  const double by_face = -200 * share_of(kFaceVariance);
  const auto both = [](Point car) {
    return Aslant{.car = car, .far_off_mm = 200, .near_off_mm = -200};
  };
  EXPECT_NEAR(moved(both(kAslant)), by_end(2), 1);
  EXPECT_NEAR(moved(both(kAhead)), by_face, 1);
  EXPECT_NEAR(moved(both({3'999, 3'000})), by_end(5), 1);
  EXPECT_NEAR(moved(both({4'000, 3'000})), by_face, 1);
  // Not of what is young, or not known to move, or where.
  Aslant young = both(kAslant);
  young.updates = 5;
  EXPECT_NEAR(moved(young), by_face, 1);
  Aslant standing = both(kAslant);
  standing.state = State::kYoung;
  EXPECT_NEAR(moved(standing), by_face, 1);
  Aslant anywhere = both(kAslant);
  anywhere.has_heading = false;
  EXPECT_NEAR(moved(anywhere), by_face, 1);
}

// Three deviations of the place and 500 mm: farther away something hides it.
TEST(Measure, AFarEndThatIsElsewhereIsHidden) {
  constexpr Point kAslant{-1'999, -1'000};
  EXPECT_GT(moved({.car = kAslant, .far_off_mm = -800}), -1'000);
  EXPECT_LT(moved({.car = kAslant, .far_off_mm = -800}), -200);
  EXPECT_NEAR(moved({.car = kAslant, .far_off_mm = -801}), 0, 1);
}

// Then the face is said to be hidden if it is not where it may be: three deviations and 200 mm.
TEST(Measure, AFaceThatIsElsewhereIsSaidToBeHidden) {
  constexpr Point kAslant{-1'999, -1'000};
  EXPECT_FALSE(measured({.car = kAslant, .near_off_mm = 500}).seen.is_end_hidden);
  EXPECT_TRUE(measured({.car = kAslant, .near_off_mm = 501}).seen.is_end_hidden);
}

// A bend turns the speed of what is fast, and nothing else fades its speed across.
TEST(Measure, WhatIsFastWandersMoreAcross) {
  const auto wander = [](std::int32_t speed) {
    Track track;
    track.begin(1, {.sides = {Interval{0, 4'000}, Interval{0, 2'000}}}, kBornAtUs);
    track.begin_heading(track.box().sides);
    track.correct(kAlong, {.place = 0, .speed = 1 << 16}, speed);
    track.covariance(kAcross) = {10'000, 0, 1'000'000};
    track.predict(Step(200));
    return track.covariance(kAcross).speed() - 1'000'000;
  };
  EXPECT_NEAR(wander(14'999), 0.2 * 700 * 700, 10);
  EXPECT_NEAR(wander(15'000), 0.2 * 1'200 * 1'200, 30);
}

// "From 3 updates on an innovation is cut to three deviations and 100."
TEST(Measure, AnInnovationIsCutFromTheThirdUpdateOn) {
  const double most = 3 * std::sqrt(kBirthVariance + kFaceVariance) + 100;
  constexpr Point kBehind{-5'000, 1'000};
  EXPECT_NEAR(moved_by(1'000, kBehind, 2), 1'000 * share_of(kFaceVariance), 1);
  EXPECT_NEAR(moved_by(1'000, kBehind, 3), most * share_of(kFaceVariance), 2);
  EXPECT_NEAR(moved_by(-1'000, kBehind, 3), -most * share_of(kFaceVariance), 2);
  EXPECT_NEAR(moved_by(300, kBehind, 3), 300 * share_of(kFaceVariance), 1);
}

}  // namespace
}  // namespace iog::objects
