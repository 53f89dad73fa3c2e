// The borders of what a track is judged by, as docs/objects.md has them.
#include "objects/judge.hpp"

#include <gtest/gtest.h>

namespace iog::objects {
namespace {

constexpr std::uint64_t kBeginUs = 1'000'000'000;
constexpr Step kStep{40};
constexpr Interval kCarsWidth{0, 2000};  // so wide that few hits are no streak

// So long, and so fast along itself, mm/s.
Track track_of(std::int32_t length_mm, std::int32_t speed) {
  Track track;
  track.begin(1, {.sides = {Interval{0, length_mm}, kCarsWidth}}, kBeginUs);
  track.correct(kAlong, {.place = 0, .speed = 1 << 16}, speed);
  track.seen.hits = 5;
  return track;
}

// One of which the speed is as sure as it gets.
Track sure_track_of(std::int32_t speed) {
  Track track = track_of(4500, speed);
  track.covariance(kAlong) = {100, 0, 100};
  track.covariance(kAcross) = {100, 0, 100};
  track.predict(Step(1));
  return track;
}

// "40 % of them called moving", and two at least: then a track's confidence grows by 2, though the
// grid has shown nothing of its places.
TEST(Judge, ATrackIsToldIfTheGridCallsTwoFifthsOfItsHitsMoving) {
  struct Case {
    std::int32_t moving;
    std::int32_t hits;
    bool is_told;
  };
  for (const Case its : {Case{2, 5, true}, Case{2, 6, false}, Case{1, 1, false}, Case{4, 10, true},
                         Case{39, 98, false}, Case{40, 100, true}}) {
    Track track = sure_track_of(2000);
    track.seen.hits = its.hits;
    track.seen.moving = its.moving;
    track.confidence = 1;
    judge(kBeginUs, track);
    EXPECT_EQ(track.confidence, its.is_told ? 3 : 1) << its.moving << " of " << its.hits;
  }
}

// "At least two good places, and four times as many as bad ones" add a frame; more bad places than
// a quarter of the others take two back, and one among many that say nothing takes none.
TEST(Judge, AFrameOpposesTheMotionByTheShareOfItsBadPlaces) {
  const auto unopposed_after = [](std::int32_t good, std::int32_t bad, std::int32_t neutral) {
    Track track = sure_track_of(2000);
    track.seen.good = good;
    track.seen.bad = bad;
    track.seen.neutral = neutral;
    track.unopposed = 3;
    judge(kBeginUs, track);
    return track.unopposed;
  };
  EXPECT_EQ(unopposed_after(2, 0, 0), 4);
  EXPECT_EQ(unopposed_after(1, 0, 9), 3);
  EXPECT_EQ(unopposed_after(8, 2, 0), 4);
  EXPECT_EQ(unopposed_after(8, 3, 0), 1);
  EXPECT_EQ(unopposed_after(8, 8, 0), 1);  // walkers beside a parked car
  EXPECT_EQ(unopposed_after(1, 1, 14), 3);
  EXPECT_EQ(unopposed_after(1, 1, 2), 1);
  EXPECT_EQ(unopposed_after(0, 0, 0), 3);
}

std::int32_t confidence_of(std::int32_t length_mm, std::int32_t width_mm, std::int32_t hits,
                           std::int32_t speed = 2000) {
  Track track = sure_track_of(speed);
  track.sides() = {Interval{0, length_mm}, Interval{0, width_mm}};
  track.seen = {.hits = hits, .moving = hits};
  track.confidence = 4;
  judge(kBeginUs, track);
  return track.confidence;
}

// What a beam draws on the ground is long, thin and of few hits: it is not told, whatever the grid
// calls it, and loses confidence twice as fast.
TEST(Judge, AStreakOfFewHitsIsNotBelieved) {
  EXPECT_EQ(confidence_of(1200, 299, 7), 2);
  EXPECT_EQ(confidence_of(299, 1200, 7), 2);
  EXPECT_EQ(confidence_of(1200, 299, 8), 6);
  EXPECT_EQ(confidence_of(1200, 300, 7), 6);
  EXPECT_EQ(confidence_of(1199, 299, 7), 6);
}

// The same for what is shorter, if it is a row of cells: three hits and half a metre.
TEST(Judge, AShortRowOfCellsIsNotBelieved) {
  EXPECT_EQ(confidence_of(500, 99, 3, 4000), 2);
  EXPECT_EQ(confidence_of(1199, 99, 3, 4000), 2);
  EXPECT_EQ(confidence_of(499, 99, 3, 4000), 6);
  EXPECT_EQ(confidence_of(500, 100, 3, 4000), 6);
  EXPECT_EQ(confidence_of(500, 99, 4, 4000), 6);
  EXPECT_EQ(confidence_of(500, 99, 3, 15'000), 6) << "a car far ahead";
}

// "Less than a hit in 0.25 m of its length": what does not move yet is not believed to, but for
// walkers side by side.
TEST(Judge, ALongTrackOfFewHitsDoesNotBeginToMove) {
  struct Case {
    std::int32_t hits;
    std::int32_t moving;
    std::int32_t width_mm;
    std::int32_t speed;
    State state;
    bool is_believed;
  };
  constexpr State kYoung = State::kYoung;
  for (const Case its : {
           Case{15, 15, 1999, 4000, kYoung, false},
           Case{16, 16, 1999, 4000, kYoung, true},
           Case{15, 15, 2000, 4000, kYoung, true},
           Case{15, 15, 1999, 15'000, kYoung, true},
           Case{15, 15, 1999, 4000, State::kMoves, true},  // and some of it is hidden now
           Case{12, 9, 1999, 1499, kYoung, true},          // three of four: two walkers
           Case{12, 9, 1999, 1501, kYoung, false},
           Case{12, 8, 1999, 1499, kYoung, false},
           Case{7, 7, 1999, 1499, kYoung, false},
       }) {
    Track track = sure_track_of(its.speed);
    track.sides() = {Interval{0, 4000}, Interval{0, its.width_mm}};
    track.state = its.state;
    track.seen = {.hits = its.hits, .moving = its.moving};
    track.confidence = 2;
    judge(kBeginUs, track);
    EXPECT_EQ(track.confidence, its.is_believed ? 4 : 0)
        << its.hits << " hits, " << its.moving << " moving, " << its.width_mm << " mm, "
        << its.speed << " mm/s";
  }
}

// Nor is it fast: places that it has left do not speak for it.
TEST(Judge, AStreakIsNotBelievedForPlacesThatItHasLeft) {
  Track track = sure_track_of(2000);
  track.updates = kMovesFrom;
  track.sides() = {Interval{0, 3000}, Interval{0, 100}};
  track.seen = {.hits = 7, .good = 7};
  track.confidence = 4;
  judge(kBeginUs, track);
  EXPECT_EQ(track.confidence, 2);
}

// "From 15 m/s on + 3 for 8 good": an oncoming car is in view for half a second.
TEST(Judge, MuchGoodAtAHighSpeedConvincesSooner) {
  struct Case {
    std::int32_t speed;
    std::int32_t good;
    std::int32_t bad;
    std::int32_t more;
  };
  for (const Case its : {Case{15'100, 8, 2, 3}, Case{14'900, 8, 2, 2}, Case{15'100, 7, 1, 2},
                         Case{15'100, 8, 3, 0}, Case{15'100, 12, 3, 3}}) {
    Track track = sure_track_of(its.speed);
    track.updates = kMovesFrom;
    track.seen = {.hits = 20, .good = its.good, .bad = its.bad};
    judge(kBeginUs, track);
    EXPECT_EQ(track.confidence, its.more) << its.speed << ", " << its.good << ", " << its.bad;
  }
}

// A car that keeps ahead leaves ground that the grid knows little of: most of it is neutral. It is
// believed once its box has been like a car's for 50 updates.
TEST(Judge, WhatIsLongLikeACarIsBelievedThoughMostOfItsPlacesAreUnknown) {
  struct Case {
    std::uint32_t updates;
    std::int32_t length_mm;
    std::int32_t width_mm;
    std::int32_t good;
    std::int32_t bad;
    bool is_believed;
  };
  for (const Case its : {Case{50, 4500, 1800, 2, 0, true}, Case{49, 4500, 1800, 2, 0, false},
                         Case{50, 6001, 1800, 2, 0, false}, Case{50, 2499, 1800, 2, 0, false},
                         Case{50, 4500, 1199, 2, 0, false}, Case{50, 4500, 2801, 2, 0, false},
                         Case{50, 4500, 1800, 1, 0, false}, Case{50, 4500, 1800, 4, 1, true},
                         Case{50, 4500, 1800, 3, 1, false}}) {
    Track track = sure_track_of(10'000);
    track.begin_heading({Interval{0, its.length_mm}, Interval{0, its.width_mm}});
    track.updates = its.updates;
    track.seen = {.hits = 30, .good = its.good, .bad = its.bad, .neutral = 36};
    judge(kBeginUs, track);
    EXPECT_EQ(track.confidence, its.is_believed ? 2 : 0)
        << its.updates << " updates, " << its.length_mm << " mm by " << its.width_mm << ", "
        << its.good << ", " << its.bad;
  }
}

// "Bad of 8 and more and 8 good": three more are lost than for what is not shown.
TEST(Judge, WhatEightPlacesSpeakAgainstForOneIsSoonNotBelieved) {
  struct Case {
    std::int32_t good;
    std::int32_t bad;
    std::int32_t lost;
  };
  for (const Case its : {Case{0, 7, 1}, Case{0, 8, 4}, Case{1, 7, 1}, Case{1, 8, 4}, Case{2, 15, 1},
                         Case{2, 16, 4}}) {
    Track track = sure_track_of(2000);
    track.seen.good = its.good;
    track.seen.bad = its.bad;
    track.confidence = kMostConfidence;
    judge(kBeginUs, track);
    EXPECT_EQ(track.confidence, kMostConfidence - its.lost) << its.good << ", " << its.bad;
  }
}

// "Slower than 0.3 m/s for 0.4 s": without a break, and a faster frame is one.
TEST(Judge, ATrackThatIsSlowTwiceButNeverForLongMoves) {
  const auto judged = [](Track& track, std::uint64_t ms, std::int32_t speed) {
    track.correct(kAlong, {.place = 0, .speed = 1 << 16}, speed - track.velocity().x);
    track.confidence = kMostConfidence;
    judge(kBeginUs + ms * 1000, track);
    return track.state;
  };
  Track track = sure_track_of(5000);
  track.state = State::kMoves;
  EXPECT_EQ(judged(track, 0, 200), State::kMoves);
  EXPECT_EQ(judged(track, 360, 200), State::kMoves);
  EXPECT_EQ(judged(track, 400, 300), State::kMoves);
  EXPECT_EQ(judged(track, 440, 299), State::kMoves);
  EXPECT_EQ(judged(track, 839, 200), State::kMoves);
  EXPECT_EQ(judged(track, 840, 200), State::kStopped);
  EXPECT_EQ(track.stopped_us, kBeginUs + 440'000);
  EXPECT_EQ(track.speed(), 0);
}

// "It has come less than 0.18 m far in 0.48 s": its speed may be that of hits that come and go.
TEST(Judge, ATrackThatDoesNotComeFarHasStopped) {
  struct Case {
    std::int32_t way_mm;
    std::uint64_t ms;
    bool has_stopped;
  };
  for (const Case its : {Case{179, 480, true}, Case{180, 480, false}, Case{0, 479, false},
                         Case{209, 560, true}, Case{210, 560, false}}) {
    Track track = sure_track_of(2000);
    track.state = State::kMoves;
    track.confidence = kMostConfidence;
    Box then = track.box();
    then.at.y_mm -= its.way_mm;
    track.snapshots.begin(kBeginUs, then).count = 1;
    judge(kBeginUs + its.ms * 1000, track);
    EXPECT_EQ(track.state, its.has_stopped ? State::kStopped : State::kMoves)
        << its.way_mm << " mm in " << its.ms << " ms";
    if (its.has_stopped) {
      EXPECT_EQ(track.stopped_us, kBeginUs);
      EXPECT_EQ(track.speed(), 0);
    }
  }
}

// "A track ends when its box is longer than 20 m."
TEST(Judge, ATrackOfTwentyMetresIsTheLongest) {
  Track longest = track_of(20'000, 0);
  EXPECT_TRUE(is_judged(kBeginUs, kStep, longest));
  Track longer = track_of(20'001, 0);
  EXPECT_FALSE(is_judged(kBeginUs, kStep, longer));
  EXPECT_FALSE(longer.is_there());
}

// "For 0.4 s three hits and four times as many as others in its box stood, below 3 m/s."
TEST(Judge, ATrackHasParkedIfFourOfFiveOfItsHitsStand) {
  struct Case {
    std::int32_t standing;
    std::int32_t hits;
    std::int32_t speed;
    bool is_parked;
  };
  for (const Case its : {Case{12, 3, 2999, true}, Case{11, 3, 2999, false}, Case{3, 0, 0, true},
                         Case{2, 0, 0, false}, Case{12, 3, 3000, false}}) {
    Track track = sure_track_of(its.speed);
    track.state = State::kMoves;
    track.seen.hits = its.hits;
    track.seen.standing = its.standing;
    for (int frame = 1; frame <= 10; ++frame) {
      EXPECT_TRUE(track.moves()) << its.standing << " of " << its.hits << ", frame " << frame;
      static_cast<void>(is_judged(kBeginUs, kStep, track));
    }
    EXPECT_EQ(track.state == State::kStopped, its.is_parked)
        << its.standing << " beside " << its.hits << " at " << its.speed;
  }
}

// "Unseen for 100 ms, 480 ms if it moves or has stopped."
TEST(Judge, ATrackThatIsNotSeenEnds) {
  const auto lasts = [](State state, std::uint64_t unseen_us) {
    Track track = sure_track_of(2000);
    track.state = state;
    track.seen = {};
    static_cast<void>(is_judged(kBeginUs + unseen_us, kStep, track));
    return track.is_there();
  };
  for (const State state : {State::kYoung, State::kStands}) {
    EXPECT_TRUE(lasts(state, 100'000));
    EXPECT_FALSE(lasts(state, 100'001));
  }
  for (const State state : {State::kMoves, State::kStopped}) {
    EXPECT_TRUE(lasts(state, 480'000));
    EXPECT_FALSE(lasts(state, 480'001));
  }
}

}  // namespace
}  // namespace iog::objects
