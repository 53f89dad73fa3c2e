// When two tracks are one thing: docs/objects.md, "Merge".
#include "objects/merge.hpp"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>

namespace iog::objects {
namespace {

constexpr std::uint64_t kBothBornUs = 1'000'000'000;

Track track_at(std::uint32_t id, Point at, std::int32_t length_mm, std::int32_t speed = 5'000) {
  Track track;
  track.begin(id, {.at = at, .sides = {Interval{0, length_mm}, Interval{0, 1'800}}}, kBothBornUs);
  track.updates = 6;
  track.correct(kAlong, {.place = 0, .speed = 1 << 16}, speed);
  return track;
}
// From 10 m to 14 m.
Track older() { return track_at(3, {10'000, 0}, 4'000); }

// Whether the second, which is the younger, becomes a part of the first, with its hits.
bool become_one(const Track& first, const Track& second) {
  std::array tracks{second, first};  // slots have no order
  std::array<FrameHit, 2> hits{};
  hits[0].owner = 0;
  merge(tracks, hits);
  EXPECT_TRUE(tracks[1].is_there());
  EXPECT_EQ(hits[0].owner, tracks[0].is_there() ? 0 : 1);
  EXPECT_EQ(hits[1].owner, kNobody);
  EXPECT_EQ(tracks[1].seen.has_merged, !tracks[0].is_there());
  return !tracks[0].is_there();
}

// Whichever corner of the younger one it is.
TEST(Merge, TracksWithinHalfAMetreAreOneThing) {
  EXPECT_TRUE(become_one(older(), track_at(4, {8'500, 0}, 1'000)));
  EXPECT_FALSE(become_one(older(), track_at(4, {8'499, 0}, 1'000)));
  EXPECT_TRUE(become_one(older(), track_at(4, {14'500, 0}, 1'000)));
  EXPECT_FALSE(become_one(older(), track_at(4, {14'501, 0}, 1'000)));
  EXPECT_TRUE(become_one(older(), track_at(4, {12'000, 1'400}, 1'000)));
  EXPECT_FALSE(become_one(older(), track_at(4, {12'000, 1'401}, 1'000)));  // 3.2 m wide
}

TEST(Merge, OneThingIsAtMostEighteenMetresLong) {
  EXPECT_TRUE(become_one(older(), track_at(4, {14'000, 0}, 14'000)));
  EXPECT_FALSE(become_one(older(), track_at(4, {14'000, 0}, 14'001)));
}

TEST(Merge, OneThingHasOneSpeed) {
  for (const std::int32_t off : {-1'500, 1'500}) {
    EXPECT_TRUE(become_one(older(), track_at(4, {12'000, 0}, 1'000, 5'000 + off)));
    EXPECT_FALSE(
        become_one(older(), track_at(4, {12'000, 0}, 1'000, 5'000 + off + (off > 0 ? 1 : -1))));
  }
}

// A side and a face of one car that both move may differ by 4 m/s, along both axes. Not those of a
// walker beside it, nor of what is not known to move.
TEST(Merge, PartsOfACarThatMovesMayDifferInSpeed) {
  const auto moving = [](Track track) {
    track.state = State::kMoves;
    return track;
  };
  const auto small = [](Track track, std::int32_t longest_mm) {
    track.sides() = {Interval{0, 1'000}, Interval{0, longest_mm}};
    return track;
  };
  const Track car = moving(older());
  for (const std::int32_t off : {-4'000, 4'000}) {
    const std::int32_t more = off > 0 ? 1 : -1;
    EXPECT_TRUE(become_one(car, moving(track_at(4, {12'000, 0}, 1'000, 5'000 + off))));
    EXPECT_FALSE(become_one(car, moving(track_at(4, {12'000, 0}, 1'000, 5'000 + off + more))));
    Track across = moving(track_at(4, {12'000, 0}, 1'000));
    across.correct(kAcross, {.place = 0, .speed = 1 << 16}, off);
    EXPECT_TRUE(become_one(car, across));
    across.correct(kAcross, {.place = 0, .speed = 1 << 16}, more);
    EXPECT_FALSE(become_one(car, across));
  }
  const Track faster = track_at(4, {12'000, 0}, 1'000, 6'501);
  EXPECT_FALSE(become_one(car, faster));
  EXPECT_FALSE(become_one(older(), moving(faster)));
  EXPECT_TRUE(become_one(car, moving(small(faster, 1'200))));
  EXPECT_FALSE(become_one(car, moving(small(faster, 1'199))));
  EXPECT_FALSE(become_one(small(car, 1'199), moving(track_at(4, {10'000, 0}, 1'000, 6'501))));
}

TEST(Merge, ATrackOfFiveUpdatesIsNotKnownWellEnough) {
  Track young = track_at(4, {12'000, 0}, 1'000);
  young.updates = 5;
  EXPECT_FALSE(become_one(older(), young));
}

// "Not if just one of them moves and the other is slower than 0.6 m/s."
TEST(Merge, WhatStandsIsNoPartOfWhatMoves) {
  Track moving = track_at(3, {10'000, 0}, 4'000, 1'000);
  moving.state = State::kMoves;
  EXPECT_TRUE(become_one(moving, track_at(4, {12'000, 0}, 1'000, 600)));
  EXPECT_FALSE(become_one(moving, track_at(4, {12'000, 0}, 1'000, 599)));
  Track slow = track_at(4, {12'000, 0}, 1'000, 599);
  slow.state = State::kMoves;
  EXPECT_TRUE(become_one(moving, slow));
}

}  // namespace
}  // namespace iog::objects
