#include "tools/view/stream_health.hpp"

#include "gtest/gtest.h"

namespace iog::tools::view {
namespace {

TEST(StreamHealth, ItWaitsUntilTheFirstFrame) {
  const StreamHealth health;
  EXPECT_EQ(health.state(0), StreamState::kWaiting);
  EXPECT_EQ(health.state(1'000'000), StreamState::kWaiting);
}

TEST(StreamHealth, WithoutFramesItIsStaleAfterHalfASecond) {
  StreamHealth health;
  health.note_frame(1000);
  EXPECT_EQ(health.state(1000), StreamState::kLive);
  EXPECT_EQ(health.state(1499), StreamState::kLive);
  EXPECT_EQ(health.state(1500), StreamState::kStale);
  EXPECT_EQ(health.silent_ms(61'000), 60'000);
  health.note_frame(61'000);
  EXPECT_EQ(health.state(61'000), StreamState::kLive);
}

TEST(StreamHealth, AnotherVersionIsIncompatibleOnlyWhereNothingElseComes) {
  StreamHealth health;
  health.note_counts({.other_version = 1}, 0);
  EXPECT_EQ(health.state(1), StreamState::kIncompatible);
  health.note_frame(10);
  EXPECT_EQ(health.state(10), StreamState::kLive);
  EXPECT_TRUE(health.has_other_version_lately(10));
  EXPECT_EQ(health.state(1000), StreamState::kIncompatible);
  EXPECT_EQ(health.state(4000), StreamState::kStale);
}

TEST(StreamHealth, WhatIsNotUnderstoodIsIncompatible) {
  StreamHealth health;
  health.note_counts({.not_understood = 3}, 0);
  EXPECT_EQ(health.state(0), StreamState::kIncompatible);
  EXPECT_FALSE(health.has_other_version_lately(0));
}

TEST(StreamHealth, RestartsAndCorruptMessagesAreSaidForThreeSeconds) {
  StreamHealth health;
  health.note_counts({.corrupt = 1, .restarts = 1}, 100);
  health.note_counts({.corrupt = 1, .restarts = 1}, 2000);
  EXPECT_TRUE(health.has_restarted_lately(3099));
  EXPECT_TRUE(health.is_corrupt_lately(3099));
  EXPECT_FALSE(health.has_restarted_lately(3100));
  EXPECT_FALSE(health.is_corrupt_lately(3100));
  health.note_counts({.corrupt = 1, .malformed = 1, .restarts = 1}, 5000);
  EXPECT_TRUE(health.is_corrupt_lately(5000));
  EXPECT_FALSE(health.has_restarted_lately(5000));
}

// A target that is too slow leaves points every 100 ms, not in every frame.
TEST(StreamHealth, ATargetThatLeftPointsIsTooSlowForThreeSeconds) {
  StreamHealth health;
  health.note_points_not_taken(0, 0);
  EXPECT_FALSE(health.is_too_slow_lately(0));
  health.note_points_not_taken(384, 40);
  health.note_points_not_taken(0, 80);
  EXPECT_TRUE(health.is_too_slow_lately(3039));
  EXPECT_FALSE(health.is_too_slow_lately(3040));
  health.note_points_not_taken(1, 4000);
  EXPECT_TRUE(health.is_too_slow_lately(4000));
}

TEST(StreamHealth, TheEndOfARecordingIsNoSilence) {
  StreamHealth health;
  health.note_frame(0);
  health.note_end();
  EXPECT_EQ(health.state(100'000), StreamState::kEnded);
}

}  // namespace
}  // namespace iog::tools::view
