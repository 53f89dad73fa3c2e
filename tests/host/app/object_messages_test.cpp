// What is told of tracks (docs/spec.md 3.12): boxes by their geometry, deviations by the roots of
// their variances, and a speed of nothing but what moves.
#include "app/object_messages.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>

#include "app/perception_sink.hpp"
#include "fakes/fake_platform.hpp"

namespace iog::app {
namespace {

using objects::kAcross;
using objects::kAlong;
using objects::State;
using objects::Track;
using stream::ObjectRecord;
using stream::ObjectState;
using tests::FakePlatform;

constexpr std::uint64_t kNowUs = 5'000'000'000;
constexpr objects::Point kCar{100'000, 0};  // far away

// Born at rest 5 s ago: 100 mm and 10 m/s deviations, of which twice as much is stated after 5 s.
// Its point is 1 m behind its middle.
Track something(std::uint32_t id) {
  Track track;
  track.begin(id, {.at = {10'000, -2'000}, .sides = {{{-1000, 3000}, {-900, 904}}}}, kNowUs);
  track.updates = kToldFrom;
  track.born_us = kNowUs - 5'000'000;
  return track;
}

// Heads to the local frame's -y at so many mm/s, and is believed.
Track car(std::uint32_t id, std::int32_t speed) {
  Track track = something(id);
  track.turn({0, -(1 << objects::kDirectionBits)});
  track.begin_heading({{{-1000, 3000}, {-900, 904}}});
  track.correct(kAlong, {.place = 0, .speed = 1 << 16}, speed);
  track.state = State::kMoves;
  track.confidence = 6;
  return track;
}

TEST(ObjectMessages, ACarThatMovesIsToldAsItIs) {
  const ObjectRecord object = record_of(car(9, 12'345), kNowUs, kCar);
  EXPECT_EQ(object, (ObjectRecord{.id = 9,
                                  .state = ObjectState::kMoves,
                                  .existence = 127,
                                  .age_frames = 4,
                                  .x_mm = 10'002,
                                  .y_mm = -3'000,
                                  .length_cm = 400,
                                  .width_cm = 180,
                                  .heading = 0xC000,
                                  .flags = stream::kObjectHasHeading,
                                  .vx_cm_s = 0,
                                  .vy_cm_s = -1234,
                                  .sigma_v_along_cm_s = 2000,
                                  .sigma_v_across_cm_s = 2000,
                                  .sigma_along_mm = 100,
                                  .sigma_across_mm = 100,
                                  .since_hit_ms = 0,
                                  .since_stopped_10ms = 65535}));
}

// What a filter says of its speed is nobody's business: four of five things that stand have one.
TEST(ObjectMessages, WhatIsNotBelievedHasNoSpeed) {
  for (const State state : {State::kYoung, State::kStands}) {
    Track track = car(9, 12'345);
    track.state = state;
    const ObjectRecord object = record_of(track, kNowUs, kCar);
    EXPECT_EQ(object.state, state == State::kYoung ? ObjectState::kYoung : ObjectState::kStands);
    EXPECT_EQ(object.vx_cm_s, 0);
    EXPECT_EQ(object.vy_cm_s, 0);
    EXPECT_EQ(object.sigma_v_along_cm_s, stream::kNotBelieved);
    EXPECT_EQ(object.sigma_v_across_cm_s, stream::kNotBelieved);
  }
}

TEST(ObjectMessages, WhatHasStoppedIsToldSinceWhen) {
  Track track = car(9, 200);
  track.state = State::kStopped;
  track.rest();
  track.stopped_us = kNowUs - 1'239'999;
  ObjectRecord object = record_of(track, kNowUs, kCar);
  EXPECT_EQ(object.state, ObjectState::kStopped);
  EXPECT_EQ(object.since_stopped_10ms, 123);
  EXPECT_EQ(object.vy_cm_s, 0);
  EXPECT_EQ(object.sigma_v_along_cm_s, 2000);
  track.stopped_us = kNowUs - 700'000'000;
  EXPECT_EQ(record_of(track, kNowUs, kCar).since_stopped_10ms, 65535);
}

TEST(ObjectMessages, WhatWasNotHitIsToldSinceWhen) {
  Track track = something(1);
  EXPECT_EQ(record_of(track, kNowUs, kCar).flags, 0);
  EXPECT_EQ(record_of(track, kNowUs + 47'900, kCar).flags, stream::kObjectNotHit);
  EXPECT_EQ(record_of(track, kNowUs + 47'900, kCar).since_hit_ms, 47);
  EXPECT_EQ(record_of(track, kNowUs + 70'000'000, kCar).since_hit_ms, 65535);
  track.seen.is_end_hidden = true;
  EXPECT_EQ(record_of(track, kNowUs, kCar).flags, stream::kObjectEndHidden);
}

// The younger and the nearer, the wider.
TEST(ObjectMessages, VelocitiesAreAsSureAsTheyAreOldAndFar) {
  Track track = car(1, 5'000);
  const auto stated = [&](std::uint64_t age_us, objects::Point from) {
    track.born_us = kNowUs - age_us;
    return record_of(track, kNowUs, from).sigma_v_along_cm_s;
  };
  EXPECT_EQ(stated(500'000, kCar), 10'000);  // 11 times 10 m/s: not more than anything can have
  EXPECT_EQ(stated(1'000'000, kCar), 6'000);
  EXPECT_EQ(stated(50'000'000, kCar), 1'100);
  EXPECT_EQ(stated(50'000'000, {19'000, -2'000}), 4'000);
  EXPECT_EQ(stated(1'000'000, {19'000, -2'000}), 6'000);
  EXPECT_EQ(stated(50'000'000, {20'000, -2'000}), 1'100);
}

// By floating point, and never less than they are.
TEST(ObjectMessages, DeviationsFollowThoseOfTheFilter) {
  Track track = car(1, 5'000);
  for (int step = 0; step < 200; ++step) {
    track.predict(objects::Step(40));
    if (step % 3 == 0) {
      static_cast<void>(track.covariance(kAlong).measure(10'000));
      static_cast<void>(track.covariance(kAcross).measure(3'000));
    }
    const ObjectRecord object = record_of(track, kNowUs, kCar);
    const auto root = [&](objects::Side side, bool of_speed) {
      const objects::Covariance& its = track.covariance(side);
      return std::sqrt(static_cast<double>(of_speed ? its.speed() : its.place()));
    };
    ASSERT_EQ(object.sigma_along_mm, std::ceil(root(kAlong, false)));
    ASSERT_EQ(object.sigma_across_mm, std::ceil(root(kAcross, false)));
    ASSERT_EQ(object.sigma_v_along_cm_s, std::ceil(2 * std::ceil(root(kAlong, true)) / 10));
    ASSERT_EQ(object.sigma_v_across_cm_s, std::ceil(2 * std::ceil(root(kAcross, true)) / 10));
  }
}

TEST(ObjectMessages, ConfidenceIsToldInPartsOf255) {
  Track track = something(1);
  EXPECT_EQ(record_of(track, kNowUs, kCar).existence, 0);
  track.confidence = 5;
  EXPECT_EQ(record_of(track, kNowUs, kCar).existence, 106);
  track.confidence = objects::kMostConfidence;
  EXPECT_EQ(record_of(track, kNowUs, kCar).existence, 255);
}

class ObjectListing : public testing::Test {
 protected:
  void list() { list_objects(*tracks, time_us, counts, {}, *told); }

  std::uint64_t time_us = kNowUs;
  objects::FrameCounts counts{};
  std::unique_ptr<objects::Tracks> tracks = std::make_unique<objects::Tracks>();
  std::unique_ptr<stream::ObjectList> told = std::make_unique<stream::ObjectList>();
};

TEST_F(ObjectListing, IsInTheOrderOfIds) {
  (*tracks)[0] = something(700);
  (*tracks)[3] = car(5, 1000);
  (*tracks)[255] = something(70'000);
  (*tracks)[7] = something(6);
  list();
  ASSERT_EQ(told->count, 4);
  const std::uint32_t ids[] = {5, 6, 700, 70'000};
  EXPECT_TRUE(std::ranges::equal(told->all(), ids, {}, &ObjectRecord::id));
  EXPECT_EQ(told->records[0], record_of((*tracks)[3], kNowUs, {}));
  EXPECT_EQ(told->time_us, kNowUs);
}

TEST_F(ObjectListing, LeavesOutWhatWasSeenInThreeFrames) {
  (*tracks)[0] = something(1);
  (*tracks)[1] = something(2);
  (*tracks)[1].updates = 3;
  list();
  ASSERT_EQ(told->count, 1);
  EXPECT_EQ(told->records[0].id, 1U);
}

TEST_F(ObjectListing, HasRoomForAll) {
  for (std::uint32_t i = 0; i < objects::kMostTracks; ++i) {
    (*tracks)[i] = something(1000 - i);
  }
  list();
  EXPECT_EQ(told->count, 256);
  EXPECT_TRUE(std::ranges::is_sorted(told->all(), {}, &ObjectRecord::id));
}

TEST_F(ObjectListing, OfAFrameWithoutAPlaceIsEmpty) {
  (*tracks)[0] = something(1);
  list();
  time_us = 0;
  list();
  EXPECT_EQ(told->count, 0);
  EXPECT_FALSE(told->has_place());
}

TEST_F(ObjectListing, SaysWhatThereWasNoRoomFor) {
  counts.tracks_refused = 3;
  counts.hits.beyond = 40;
  counts.hits_not_clustered = 2;
  list();
  EXPECT_EQ(told->tracks_refused, 3);
  EXPECT_EQ(told->hits_left, 42);
  counts.tracks_refused = 70'000;
  counts.hits.beyond = UINT32_MAX;
  list();
  EXPECT_EQ(told->tracks_refused, 65535);
  EXPECT_EQ(told->hits_left, 65535);
}

// Between what comes before and the frame's end, each numbered, all with the flag.
TEST_F(ObjectListing, GoesOutInParts) {
  for (std::uint32_t i = 0; i < 70; ++i) {
    (*tracks)[i] = something(i + 1);
  }
  FakePlatform platform;
  const auto sink = std::make_unique<PerceptionSink<FakePlatform>>(platform, Coding::kRaw);
  for (const bool has_objects : {true, false}) {
    list_objects(*tracks, kNowUs, {}, {}, sink->objects());
    sink->begin_frame({.flags = has_objects ? stream::kFlagObjects : std::uint8_t{0}});
    if (has_objects) {
      sink->send_objects();
    }
    sink->end_frame();
  }
  ASSERT_EQ(platform.frames.size(), 2U);
  EXPECT_EQ(platform.unreadable(), 0);
  const tests::ReceivedFrame& frame = platform.frames[0];
  EXPECT_TRUE(frame.header.has_objects());
  constexpr int kObjects = static_cast<int>(stream::MessageType::kObjects);
  EXPECT_EQ(frame.message_types, (std::vector<int>{kObjects, kObjects, kObjects, 2}));
  ASSERT_EQ(frame.objects.size(), 3U);
  std::uint32_t id = 0;
  for (const stream::ObjectPart& part : frame.objects) {
    EXPECT_EQ(part.header.objects, 70);
    for (const ObjectRecord& object : part.all()) {
      EXPECT_EQ(object, record_of((*tracks)[id++], kNowUs, {}));
    }
  }
  EXPECT_EQ(id, 70U);
  EXPECT_EQ(platform.sequences(), (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
  EXPECT_FALSE(platform.frames[1].header.has_objects());
  EXPECT_TRUE(platform.frames[1].objects.empty());
}

}  // namespace
}  // namespace iog::app
