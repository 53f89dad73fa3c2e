// Drawn things: what moves is believed to, in time and as fast as its equations say; what stands
// never is. Expectations are kinematics.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <vector>

#include "objects/drawn_scene.hpp"
#include "objects/judge.hpp"
#include "objects/measure.hpp"

namespace iog::objects::tests {
namespace {

// How far the track's velocity is from the thing's, m/s.
double velocity_error(const Scene& scene, std::size_t thing, const Track& track) {
  const auto [x, y] = scene.velocity_of(thing);
  return std::hypot(track.velocity().x * 1e-3 - x, track.velocity().y * 1e-3 - y);
}
// How far the box is turned from the thing, degrees, 0 ... 180.
double heading_error(const Scene& scene, std::size_t thing, const Track& track) {
  const Direction along = track.box().along;
  const double heading = std::atan2(along.y, along.x);
  const double off = std::remainder(heading - scene.place_of(thing).heading, 2 * 3.14159265358979);
  return std::abs(off) * 57.29577951;
}

class Things : public testing::Test {
 protected:
  // Seconds until a thing is believed to move; 1000 if it is not.
  double believed_after(Scene& scene, std::size_t thing, double most_s) {
    double after = 1000;
    scene.show_until(most_s, tracker, [&] {
      const Track* track = scene.track_of(thing, tracker);
      if (after == 1000 && track != nullptr && track->moves()) {
        after = scene.now_s();
      }
    });
    return after;
  }

  std::unique_ptr<Tracker> owner = std::make_unique<Tracker>();
  Tracker& tracker = *owner;
};

// It keeps 20 m ahead at 15 m/s. Nothing of it changes but the ground: places that it has left are
// free. 0.7 m of way show after 0.16 s at least, and two frames of confidence follow.
TEST_F(Things, ACarAheadMovesByThePlacesItHasLeft) {
  Scene scene(straight({}, 15), {{.middle = straight({.x = 20}, 15)}});
  EXPECT_LE(believed_after(scene, 0, 1.0), 0.6);
  const Track* track = scene.track_of(0, tracker);
  ASSERT_NE(track, nullptr);
  EXPECT_TRUE(track->moves());
  EXPECT_LT(velocity_error(scene, 0, *track), 0.5);
  EXPECT_LT(heading_error(scene, 0, *track), 5);
  EXPECT_DOUBLE_EQ(scene.moving_share(0, tracker), 1.0);
}

// It comes from 45 m at 9.1 m/s, aslant with its side in view, and the car drives at 9 m/s: on
// ground that was open.
TEST_F(Things, AnOncomingCarMovesOnOpenGround) {
  Scene scene(straight({}, 9), {{.middle = straight({.x = 45, .y = -6, .heading = 2.6}, 9.1)}});
  EXPECT_LE(believed_after(scene, 0, 1.2), 0.8);
  const Track* track = scene.track_of(0, tracker);
  ASSERT_NE(track, nullptr);
  EXPECT_LT(velocity_error(scene, 0, *track), 0.7);
  EXPECT_LT(heading_error(scene, 0, *track), 6);
}

// It comes straight on from 50 m at 15 m/s, the car drives at 10 m/s: all that is seen is its
// front, which hides the places that it has left.
TEST_F(Things, AFrontThatComesMovesOnOpenGround) {
  Scene scene(straight({}, 10), {{.middle = straight({.x = 50, .y = 3, .heading = M_PI}, 15)}});
  EXPECT_LE(believed_after(scene, 0, 1.2), 0.8);
  const Track* track = scene.track_of(0, tracker);
  ASSERT_NE(track, nullptr);
  EXPECT_LT(velocity_error(scene, 0, *track), 0.7);
}

// 400 m of rail, of which the car at 25 m/s sees what is within its reach: that part goes along
// with it, and a filter alone believes it. No hit of it is ever called moving.
TEST_F(Things, ARailThatGoesAlongNeverMoves) {
  Scene scene(straight({}, 25),
              {{.middle = at_rest({.x = 150, .y = 4}), .length = 400, .width = 0.3},
               {.middle = at_rest({.x = 150, .y = -6}), .length = 400, .width = 0.3}});
  scene.show_until(3, tracker, [&] {
    ASSERT_EQ(scene.moving_share(0, tracker), 0) << scene.now_s();
    ASSERT_EQ(scene.moving_share(1, tracker), 0) << scene.now_s();
  });
}

// Posts every 4 m beside the road: each looks like the one before. A filter may take the next one
// for the same.
TEST_F(Things, PostsBesideTheRoadNeverMove) {
  std::vector<Thing> posts(24);
  for (std::size_t i = 0; i < posts.size(); ++i) {
    posts[i] = {.middle = at_rest({.x = 4.0 * static_cast<double>(i), .y = 4}),
                .length = 0.2,
                .width = 0.2};
  }
  Scene scene(straight({}, 20), posts);
  scene.show_until(2.5, tracker, [&] {
    for (std::size_t i = 0; i < posts.size(); ++i) {
      ASSERT_EQ(scene.moving_share(i, tracker), 0) << i << " at " << scene.now_s();
    }
  });
}

// A walker at 1.5 m/s passes a pole at half a metre. He keeps his id, and the pole stands.
TEST_F(Things, AWalkerWhoPassesAPoleKeepsHisTrack) {
  Scene scene(at_rest({}),
              {{.middle = straight({.x = 10, .y = -3, .heading = M_PI / 2}, 1.5),
                .length = 0.5,
                .width = 0.5},
               {.middle = at_rest({.x = 10.8, .y = 0.6}), .length = 0.2, .width = 0.2}});
  EXPECT_LE(believed_after(scene, 0, 1.5), 1.3);
  std::set<std::uint32_t> ids;
  scene.show_until(4, tracker, [&] {
    const Track* track = scene.track_of(0, tracker);
    ASSERT_NE(track, nullptr);
    ids.insert(track->id);
    EXPECT_TRUE(track->moves()) << scene.now_s();
    EXPECT_LT(velocity_error(scene, 0, *track), 0.5) << scene.now_s();
    EXPECT_EQ(scene.moving_share(1, tracker), 0) << scene.now_s();
  });
  EXPECT_EQ(ids.size(), 1U);
}

// Two cars begin side by side, 0.3 m apart, and one of them is 4 m/s faster: they become two.
TEST_F(Things, TwoCarsThatPartAreTwo) {
  Scene scene(straight({}, 12), {{.middle = straight({.x = 15, .y = -1.05}, 12)},
                                 {.middle = straight({.x = 15, .y = 1.05}, 16)}});
  scene.show_until(3, tracker);
  const Track* slower = scene.track_of(0, tracker);
  const Track* faster = scene.track_of(1, tracker);
  ASSERT_NE(slower, nullptr);
  ASSERT_NE(faster, nullptr);
  EXPECT_NE(slower->id, faster->id);
  EXPECT_TRUE(slower->moves());
  EXPECT_TRUE(faster->moves());
  EXPECT_LT(velocity_error(scene, 0, *slower), 0.7);
  EXPECT_LT(velocity_error(scene, 1, *faster), 0.7);
}

// It brakes with 3 m/s^2 from 6 m/s and stands after 2 s and 6 m.
Place braking(double s) {
  const double t = std::min(s, 2.0);
  return {.x = 12 + 6 * t - 1.5 * t * t, .y = 2};
}

// It has stopped at last when most of it has stood for 0.8 s, and 0.4 s after that; then its speed
// is 0, and it is said since when.
TEST_F(Things, ACarThatParksHasStopped) {
  Scene scene(at_rest({}), {{.middle = braking}});
  EXPECT_LE(believed_after(scene, 0, 1.5), 0.8);
  double stopped = 0;
  scene.show_until(4, tracker, [&] {
    const Track* track = scene.track_of(0, tracker);
    if (track != nullptr && track->state == State::kStopped && stopped == 0) {
      stopped = scene.now_s();
      EXPECT_EQ(track->speed(), 0);
      EXPECT_NEAR((static_cast<double>(track->stopped_us) - kStartUs) * 1e-6, 2.0, 1.0);
    }
    if (scene.now_s() > 3.3) {
      EXPECT_EQ(scene.moving_share(0, tracker), 0) << scene.now_s();
    }
  });
  EXPECT_GT(stopped, 1.8);
  EXPECT_LT(stopped, 3.3);
}

// It has stood for 2 s, 12 m ahead, and leaves with 2 m/s^2: 9 m and 6 m/s in 3 s.
TEST_F(Things, ACarThatLeavesMoves) {
  const Motion leaving = [](double s) {
    const double t = std::max(s - 2, 0.0);
    return Place{.x = 12 + t * t, .y = 1};
  };
  Scene scene(at_rest({}), {{.middle = leaving}});
  scene.show_until(2, tracker, [&] { ASSERT_EQ(scene.moving_share(0, tracker), 0); });
  scene.show_until(5, tracker);
  const Track* track = scene.track_of(0, tracker);
  ASSERT_NE(track, nullptr);
  EXPECT_TRUE(track->moves());
  EXPECT_LT(velocity_error(scene, 0, *track), 1.0);
  EXPECT_GT(scene.moving_share(0, tracker), 0.9);
}

// Three hits of its own and four that stand, of a slow car, are mostly standing: it may be beside
// something that is parked. Three and three are not, nor is a walker in front of a wall, nor a car
// that drives with 8 m/s.
TEST(Track, IsMostlyStandingIfItIsLargeAndSlowAndMoreOfItsHitsStand) {
  const auto track_of = [](std::int32_t length_mm, std::int32_t standing) {
    Track track;
    track.begin(1, {.sides = {Interval{0, length_mm}, Interval{0, 600}}}, kStartUs);
    track.seen = {.hits = 3, .standing = standing};
    return track;
  };
  EXPECT_TRUE(track_of(4500, 4).is_mostly_standing());
  EXPECT_FALSE(track_of(4500, 3).is_mostly_standing());
  EXPECT_FALSE(track_of(600, 4).is_mostly_standing());
  Track fast = track_of(4500, 4);
  fast.correct(kAlong, {.place = 0, .speed = 8 << 16}, 1000);
  EXPECT_EQ(fast.speed(), 8000);
  EXPECT_FALSE(fast.is_mostly_standing());
}

// What moves and is wider than 4 m is no thing: one has passed the other, and both are in its box.
// What stands may be as wide as it is.
TEST(Track, EndsIfItMovesAndIsTooWide) {
  const auto is_kept = [](State state, std::int32_t width_mm) {
    Track track;
    track.begin(1, {}, kStartUs);
    track.begin_heading({Interval{0, 4500}, Interval{0, width_mm}});
    track.state = state;
    track.seen.hits = 3;
    return is_judged(kStartUs, Step(40), track) && track.is_there();
  };
  EXPECT_FALSE(is_kept(State::kMoves, 4100));
  EXPECT_TRUE(is_kept(State::kMoves, 3900));
  EXPECT_TRUE(is_kept(State::kStands, 4100));
}

// All that lies in the box of a track stands: nothing was seen of a car, but a walker in front of a
// pole is still there.
TEST(Track, LeavesWhatStandsIfNothingElseIsInItsBox) {
  const auto owner_after = [](std::int32_t length_mm, bool is_another_its_own) {
    Track track;
    track.begin(1, {.sides = {Interval{0, length_mm}, Interval{0, 600}}}, kStartUs);
    std::array<FrameHit, 2> hits{};
    const std::array<std::uint16_t, 2> numbers{0, 1};
    hits[0].owner = hits[1].owner = 0;
    hits[0].stands = true;
    hits[1].stands = !is_another_its_own;
    measure({}, kStartUs + 40'000, Step(40), numbers, hits, track);
    EXPECT_EQ(track.seen.standing, is_another_its_own ? 1 : 2);
    return hits[0].owner;
  };
  EXPECT_EQ(owner_after(4500, false), kNobody);
  EXPECT_EQ(owner_after(4500, true), 0);
  EXPECT_EQ(owner_after(600, false), 0);
}

// Of a car of which most hits stand these are nobody's, and the others its own.
TEST(Track, LeavesWhatStandsIfThatIsMostOfIt) {
  const auto owners_after = [](std::int32_t length_mm) {
    Track track;
    track.begin(1, {.sides = {Interval{0, length_mm}, Interval{0, 600}}}, kStartUs);
    std::array<FrameHit, 3> hits{};
    const std::array<std::uint16_t, 3> numbers{0, 1, 2};
    for (FrameHit& hit : hits) {
      hit.owner = 0;
      hit.stands = &hit != &hits[1];
    }
    measure({}, kStartUs + 40'000, Step(40), numbers, hits, track);
    return std::array{hits[0].owner, hits[1].owner, hits[2].owner};
  };
  EXPECT_EQ(owners_after(4500), (std::array<std::int16_t, 3>{kNobody, 0, kNobody}));
  EXPECT_EQ(owners_after(600), (std::array<std::int16_t, 3>{0, 0, 0}));
}

// A lorry of 16.5 m overtakes at 22 m/s a car that drives at 12: one track, and as long as it is.
// Abreast both of its ends are out of sight or seen aslant; 20 m ahead its rear is in full view.
TEST_F(Things, ALorryIsOneTrack) {
  Scene scene(straight({}, 12),
              {{.middle = straight({.x = -20, .y = 3.5}, 22), .length = 16.5, .width = 2.5}});
  scene.show_until(1.5, tracker);
  std::set<std::uint32_t> ids;
  double longest = 0;
  const Track* track = nullptr;
  scene.show_until(5, tracker, [&] {
    track = scene.track_of(0, tracker);
    ASSERT_NE(track, nullptr);
    ids.insert(track->id);
    longest = std::max(longest, track->box().sides[kAlong].length() * 1e-3);
    EXPECT_TRUE(track->moves()) << scene.now_s();
    EXPECT_LT(velocity_error(scene, 0, *track), 0.15 * 22) << scene.now_s();
  });
  EXPECT_EQ(ids.size(), 1U);
  EXPECT_NEAR(longest, 16.5, 0.7);
  EXPECT_LT(velocity_error(scene, 0, *track), 0.7);
}

// A lorry of 10 m passes 8 m beside the car at 15 m/s. A wall hides what is from 3.5 m to 10.7 m
// ahead on its near side: its front is behind the wall from 1.9 s on, its rear beside the car
// until 2.3 s.
TEST_F(Things, AnEndBehindAWallIsSaidToBeHidden) {
  Scene scene(at_rest({}),
              {{.middle = straight({.x = -30, .y = 8}, 15), .length = 10, .width = 2.5},
               {.middle = at_rest({.x = 4, .y = 4}), .length = 4, .width = 0.2}});
  const auto expect_hidden = [&](bool is_hidden) {
    const Track* track = scene.track_of(0, tracker);
    ASSERT_NE(track, nullptr);
    EXPECT_EQ(track->seen.is_end_hidden, is_hidden) << scene.now_s();
  };
  scene.show_until(1.5, tracker);
  scene.show_until(1.88, tracker, [&] { expect_hidden(false); });
  scene.show_until(2.0, tracker);
  scene.show_until(2.3, tracker, [&] { expect_hidden(true); });
}

// A lorry of 10 m passes 8 m beside the car at 15 m/s, behind two walls: its front goes out of view
// and comes into it. Its wheels hold 10 m/s^2 along and as much across, 0.4 m/s a frame each, and
// what is left of its speed across fades.
TEST_F(Things, NoEdgeThatAppearsIsFasterThanWheelsHold) {
  Scene scene(at_rest({}),
              {{.middle = straight({.x = -30, .y = 8}, 15), .length = 10, .width = 2.5},
               {.middle = at_rest({.x = -1, .y = 4}), .length = 2, .width = 0.2},
               {.middle = at_rest({.x = 4, .y = 4}), .length = 4, .width = 0.2}});
  scene.show_until(1.2, tracker);
  const Track* track = scene.track_of(0, tracker);
  ASSERT_NE(track, nullptr);
  ASSERT_TRUE(track->moves());
  Velocity before = track->velocity();
  scene.show_until(2.4, tracker, [&] {
    ASSERT_TRUE(track->moves()) << scene.now_s();
    const Velocity its = track->velocity();
    const double change = std::hypot(its.x - before.x, its.y - before.y) * 1e-3;
    EXPECT_LT(change, 0.4 * std::sqrt(2.0) + 0.1) << scene.now_s();
    EXPECT_LT(velocity_error(scene, 0, *track), 4) << scene.now_s();
    before = its;
  });
}

// The metre that is seen of a car drives 15 m ahead. From 1.2 s on a metre is seen 1.6 m before it,
// too: at 28 m/s nothing drives so close to something, so it is of the same car; at 5 m/s, in a
// queue, it may be the next.
TEST_F(Things, WhatIsSeenCloselyBeforeItIsAPartOfWhatIsFast) {
  const auto is_one = [](double speed) {
    const auto its = std::make_unique<Tracker>();
    const Motion front = [=](double s) {
      return s < 1.2 ? Place{.x = -500} : straight({.x = 17.6, .y = 2}, speed)(s);
    };
    Scene scene(straight({}, speed), {{.middle = straight({.x = 15, .y = 2}, speed), .length = 1},
                                      {.middle = front, .length = 1}});
    scene.show_until(1.4, *its);
    const Track* track = scene.track_of(0, *its);
    EXPECT_TRUE(track != nullptr && track->moves());
    EXPECT_NE(scene.track_of(1, *its), nullptr);
    return scene.track_of(1, *its) == track;
  };
  EXPECT_TRUE(is_one(28));
  EXPECT_FALSE(is_one(5));
}

// A car ahead in a bend of 250 m at 28 m/s: 3.1 m/s^2 across, 6.4 degrees a second.
TEST_F(Things, ABendAt28MetresASecondIsFollowed) {
  const auto in_bend = [](double before_m) {
    return [=](double s) {
      const double angle = (before_m + 28 * s) / 250;
      return Place{250 * std::sin(angle), 250 - 250 * std::cos(angle), angle};
    };
  };
  Scene scene(in_bend(0), {{.middle = in_bend(22)}});
  EXPECT_LE(believed_after(scene, 0, 1.0), 0.6);
  std::set<std::uint32_t> ids;
  scene.show_until(4, tracker, [&] {
    const Track* track = scene.track_of(0, tracker);
    ASSERT_NE(track, nullptr);
    ids.insert(track->id);
    EXPECT_TRUE(track->moves()) << scene.now_s();
    EXPECT_LT(velocity_error(scene, 0, *track), 1.5) << scene.now_s();
    EXPECT_LT(heading_error(scene, 0, *track), 6) << scene.now_s();
  });
  EXPECT_EQ(ids.size(), 1U);
}

}  // namespace
}  // namespace iog::objects::tests
