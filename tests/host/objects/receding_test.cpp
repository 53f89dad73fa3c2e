// Drawn things that recede from the car: the beams that end on them free the places that they left.
#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "objects/drawn_scene.hpp"

namespace iog::objects::tests {
namespace {

class Receding : public testing::Test {
 protected:
  std::unique_ptr<Tracker> owner = std::make_unique<Tracker>();
  Tracker& tracker = *owner;
};

// It keeps 18 m ahead, at 12 m/s and at 4 m/s, where the grid forgets what has left a cell after
// 0.5 s only, as one does that a unit of ten turns a second feeds: the beams that end on the rear
// say it at once.
TEST_F(Receding, ACarAheadMovesThoughTheGridForgetsLate) {
  for (const double speed : {12.0, 4.0}) {
    Scene scene(straight({}, speed), {{.middle = straight({.x = 18}, speed)}});
    scene.lag_us = 500'000;
    tracker.forget();
    scene.show_until(1.2, tracker);
    scene.show_until(4, tracker, [&] {
      EXPECT_GT(scene.moving_share(0, tracker), 0.9) << speed << " at " << scene.now_s();
    });
  }
}

// It goes away from the car, brakes, and stands: then it has stopped, and its trail is over.
TEST_F(Receding, ACarAheadThatStopsHasStopped) {
  const Motion stopping = [](double s) {
    const double t = std::clamp(s - 2, 0.0, 3.0);
    return Place{.x = 12 + 6 * std::min(s, 2.0) + 6 * t - t * t};
  };
  Scene scene(straight({}, 1), {{.middle = stopping}});
  scene.lag_us = 300'000;
  scene.show_until(2, tracker);
  EXPECT_GT(scene.moving_share(0, tracker), 0.9);
  double stopped = 0;
  scene.show_until(7, tracker, [&] {
    const Track* track = scene.track_of(0, tracker);
    if (track != nullptr && track->state == State::kStopped && stopped == 0) {
      stopped = scene.now_s();
      EXPECT_FALSE(track->has_trail());
    }
  });
  EXPECT_GT(stopped, 4.5);  // it stands from 5 s on, and is slower than 0.6 m/s from 4.7 s on
  EXPECT_LT(stopped, 6.5);
  EXPECT_EQ(scene.moving_share(0, tracker), 0);
}

// Parked cars are passed at 14 m/s: nothing moves.
TEST_F(Receding, ARowOfParkedCarsThatIsPassedStands) {
  std::vector<Thing> row(8);
  for (std::size_t i = 0; i < row.size(); ++i) {
    row[i] = {.middle = at_rest({.x = 10 + 5.5 * static_cast<double>(i), .y = -3})};
  }
  Scene scene(straight({}, 14), row);
  scene.show_until(3, tracker, [&] {
    for (std::size_t i = 0; i < row.size(); ++i) {
      ASSERT_EQ(scene.moving_share(i, tracker), 0) << i << " at " << scene.now_s();
    }
  });
}

}  // namespace
}  // namespace iog::objects::tests
