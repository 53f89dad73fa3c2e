// What a frame's hits change of a track: the rows of the table in docs/objects.md, "Measure".
#include "objects/measure.hpp"

#include <array>
#include <cmath>
#include <cstdint>
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
