// Drawn cars so slow that the grid calls most of their hits standing.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>

#include "objects/drawn_scene.hpp"

namespace iog::objects::tests {
namespace {

class Slow : public testing::Test {
 protected:
  std::unique_ptr<Tracker> owner = std::make_unique<Tracker>();
  Tracker& tracker = *owner;
};

// It comes with 6 m/s, brakes with 2 m/s^2 to 1.6 m/s in 2.2 s, and goes on so.
double way_of_one_that_brakes(double s) {
  const double braked = std::min(s, 2.2);
  return 6 * braked - braked * braked + 1.6 * std::max(s - 2.2, 0.0);
}

// Straight on for 9 m, then to the right on a circle of 7 m.
Place on_a_turn(double way) {
  const double angle = std::max(way - 9, 0.0) / 7;
  return {-9 + std::min(way, 9.0) + 7 * std::sin(angle), 8 - 7 * (1 - std::cos(angle)), -angle};
}

// It turns before the car, 3 to 8 m away. Most of its hits stand, by the grid, from 3 s on.
TEST_F(Slow, ACarThatTurnsBesideTheCarMoves) {
  Scene scene(at_rest({}),
              {{.middle = [](double s) { return on_a_turn(way_of_one_that_brakes(s)); }}});
  scene.lag_us = 200'000;
  scene.show_until(2, tracker);
  scene.show_until(5, tracker, [&] {
    EXPECT_GT(scene.moving_share(0, tracker), 0.8) << scene.now_s();
    const Track* track = scene.track_of(0, tracker);
    ASSERT_NE(track, nullptr);
    const double heading = std::atan2(track->box().along.y, track->box().along.x);
    EXPECT_NEAR(heading, scene.place_of(0).heading, 0.3) << scene.now_s();
  });
}

// It passes two parked cars, at last with 1.6 m/s, 0.4 m beside them.
TEST_F(Slow, ACarThatPassesAParkedOneLeavesItsHits) {
  Scene scene(
      at_rest({}),
      {{.middle = [](double s) { return Place{.x = -12 + way_of_one_that_brakes(s), .y = 6}; }},
       {.middle = at_rest({.x = 2, .y = 8.2})},
       {.middle = at_rest({.x = 8, .y = 8.2})}});
  scene.lag_us = 200'000;
  scene.show_until(2, tracker);
  EXPECT_GT(scene.moving_share(0, tracker), 0.8);
  scene.show_until(9, tracker, [&] {
    EXPECT_LT(scene.moving_share(1, tracker), 0.05) << scene.now_s();
    EXPECT_LT(scene.moving_share(2, tracker), 0.05) << scene.now_s();
  });
}

// It stands in the midst of its turn.
TEST_F(Slow, ACarThatStopsInItsTurnHasStopped) {
  Scene scene(
      at_rest({}),
      {{.middle = [](double s) { return on_a_turn(way_of_one_that_brakes(std::min(s, 4.0))); }}});
  scene.lag_us = 200'000;
  scene.show_until(4, tracker);
  EXPECT_GT(scene.moving_share(0, tracker), 0.8);
  scene.show_until(5.2, tracker);
  scene.show_until(7, tracker,
                   [&] { EXPECT_EQ(scene.moving_share(0, tracker), 0) << scene.now_s(); });
}

// Where beams pass over a person's legs, only the track knows that he goes on. The parked car has a
// lidar 1.5 m high, whose lowest beams are 0.6 m high 3.4 m away.
TEST_F(Slow, APersonWhoPassesAParkedCarMoves) {
  Scene scene(
      at_rest({}),
      {{.middle = straight({.x = -8, .y = 2}, 1.3), .length = 0.5, .width = 0.5, .is_told = true},
       {.middle = at_rest({.x = 0, .y = 9}), .length = 30, .width = 1}});
  scene.blind_m = 3.4;
  scene.show_until(2, tracker);
  scene.show_until(12, tracker,
                   [&] { EXPECT_GT(scene.moving_share(0, tracker), 0.8) << scene.now_s(); });
}

TEST_F(Slow, APersonWhoStopsBesideAParkedCarHasStopped) {
  Scene scene(at_rest({}),
              {{.middle = [](double s) { return Place{.x = -8 + 1.3 * std::min(s, 6.0), .y = 2}; },
                .length = 0.5,
                .width = 0.5,
                .is_told = true},
               {.middle = at_rest({.x = 0, .y = 9}), .length = 30, .width = 1}});
  scene.blind_m = 3.4;
  scene.show_until(6, tracker);
  EXPECT_GT(scene.moving_share(0, tracker), 0.8);
  scene.show_until(7.5, tracker);
  scene.show_until(9, tracker,
                   [&] { EXPECT_EQ(scene.moving_share(0, tracker), 0) << scene.now_s(); });
}

Track car_of(std::int32_t length_mm, std::int32_t width_mm, std::int32_t confidence,
             std::int32_t unopposed = 4) {
  Track track;
  track.begin(1, {}, kStartUs);
  track.begin_heading({Interval{0, length_mm}, Interval{0, width_mm}});
  track.confidence = confidence;
  track.unopposed = unopposed;
  track.seen = {.hits = 3, .standing = 4};
  return track;
}

// Four of seven hits stand.
TEST(Track, OwnsWhatStandsIfItIsSurelyACar) {
  EXPECT_FALSE(car_of(4500, 1800, 8).is_mostly_standing());
  EXPECT_TRUE(car_of(4500, 1800, 7).is_mostly_standing());
  EXPECT_TRUE(car_of(4500, 1800, 8, 3).is_mostly_standing());
  EXPECT_TRUE(car_of(4500, 1100, 8).is_mostly_standing());
  EXPECT_TRUE(car_of(4500, 2900, 8).is_mostly_standing());
  EXPECT_TRUE(car_of(2400, 1800, 8).is_mostly_standing());
  EXPECT_TRUE(car_of(6100, 1800, 8).is_mostly_standing());
  Track without_heading;
  without_heading.begin(1, {.sides = {Interval{0, 4500}, Interval{0, 1800}}}, kStartUs);
  without_heading.confidence = 8;
  without_heading.seen = {.hits = 3, .standing = 4};
  EXPECT_TRUE(without_heading.is_mostly_standing());
}

}  // namespace
}  // namespace iog::objects::tests
