// Laws of the tracker as a whole: order does not show, nothing survives a break in time, no id
// comes again, and whatever is forged is bounded.
#include "objects/tracker.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "objects/drawn_scene.hpp"

namespace iog::objects {
namespace {

using iog::tests::Random;

constexpr std::array<std::uint8_t, 5> kAges{32, 24, 16, 8, 0};
constexpr window::Area kArea = window::Area::around({0, 0});

// A grid that calls every cell the same.
struct Everywhere {
  Name name = Name::kFree;
  [[nodiscard]] Names names_around(geometry::Cell /*cell*/) const {
    return name == Name::kStanding ? Names(1U << static_cast<unsigned>(decision::Class::kStopped))
                                   : Names();
  }
  [[nodiscard]] CellName look_at(geometry::Cell /*cell*/) const {
    return {.name = name, .is_open = name == Name::kFree};
  }
};

// FNV-1a of all that is said of the tracks.
std::uint64_t hash_of(const Tracker& tracker) {
  std::uint64_t hash = 0xCBF2'9CE4'8422'2325;
  const auto add = [&](std::int64_t value) {
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ (static_cast<std::uint64_t>(value) >> 8 * byte & 0xFF)) * 0x100'0000'01B3;
    }
  };
  for (const Track& its : tracker.tracks()) {
    if (its.is_there()) {
      const Box& box = its.box();
      for (const std::int64_t value :
           {std::int64_t{its.id}, static_cast<std::int64_t>(its.state), std::int64_t{box.at.x_mm},
            std::int64_t{box.at.y_mm}, std::int64_t{box.along.x}, std::int64_t{box.sides[0].low},
            std::int64_t{box.sides[1].high}, std::int64_t{its.velocity().x},
            std::int64_t{its.velocity().y}, std::int64_t{its.speed_deviation()},
            std::int64_t{its.confidence}}) {
        add(value);
      }
    }
  }
  return hash;
}
std::size_t count(const Tracker& tracker) {
  return static_cast<std::size_t>(std::ranges::count_if(tracker.tracks(), &Track::is_there));
}

class TrackerOf : public testing::Test {
 protected:
  FrameCounts add(std::uint64_t ms, const std::vector<Hit>& hits, Name name = Name::kFree) {
    const Everywhere everywhere{name};
    return tracker.add(
        {.end_us = ms * 1'000, .car = {}, .area = kArea, .ages_ms = kAges, .hits = hits},
        GridNames(everywhere));
  }
  // Two cells that move by a cell a frame.
  FrameCounts add_pair(std::uint64_t ms, std::int32_t x) {
    return add(ms, {{.cell = {x, 50}, .slice = 4}, {.cell = {x, 51}, .slice = 4}});
  }

  std::unique_ptr<Tracker> owner = std::make_unique<Tracker>();
  Tracker& tracker = *owner;
};

tests::Scene busy_scene() {
  using tests::straight;
  return {straight({}, 10),
          {{.middle = straight({.x = 20}, 10)},
           {.middle = straight({.x = 45, .y = -6, .heading = 2.6}, 9)},
           {.middle = straight({.x = 10, .y = -5, .heading = 1.5}, 1.5), .length = .5, .width = .5},
           {.middle = tests::at_rest({.x = 40, .y = 5}), .length = 90, .width = 0.3},
           {.middle = tests::at_rest({.x = 12, .y = 3}), .length = .2, .width = .2}}};
}

// Whoever collects the hits of a frame may give them in any order, and twice.
TEST_F(TrackerOf, TheOrderOfHitsDoesNotShow) {
  const auto other = std::make_unique<Tracker>();
  tests::Scene as_they_come = busy_scene();
  tests::Scene shuffled = busy_scene();
  Random random(5);
  shuffled.reorder = [&](std::vector<Hit>& hits) {
    for (std::size_t i = 0; i < 30 && !hits.empty(); ++i) {
      hits.push_back(hits[random.below(hits.size())]);
    }
    for (std::size_t last = hits.size(); last > 1; --last) {
      std::swap(hits[last - 1], hits[random.below(last)]);
    }
  };
  bool is_any_moving = false;
  for (int frame = 0; frame < 60; ++frame) {
    as_they_come.show(tracker);
    shuffled.show(*other);
    ASSERT_EQ(hash_of(tracker), hash_of(*other)) << frame;
    is_any_moving = is_any_moving || std::ranges::any_of(tracker.tracks(), &Track::moves);
  }
  EXPECT_TRUE(is_any_moving);
}

// Tracks claim hits when these are looked up: in parts, in any order, and twice where a core is
// lost. What contradicts a track is counted once.
TEST_F(TrackerOf, HitsAreClaimedAsTheyAreLookedUp) {
  const auto other = std::make_unique<Tracker>();
  tests::Scene at_once = busy_scene();
  tests::Scene in_parts = busy_scene();
  std::ptrdiff_t claimed = 0;
  in_parts.add = [&](Tracker& its, const Frame& frame, const GridNames& grid) {
    EXPECT_TRUE(its.begin(frame));
    constexpr std::size_t kPart = 8;
    for (std::size_t end = its.hits().size(); end > 0; end -= std::min(end, kPart)) {
      const std::size_t first = end - std::min(end, kPart);
      its.look_at_hits(first, end - first, grid);
      its.look_at_hits(first, (end - first + 1) / 2, grid);
    }
    claimed += std::ranges::count_if(its.hits(), [](auto& hit) { return hit.owner != kNobody; });
    const FrameCounts counts = its.end(grid);
    its.remember_hits();
    return counts;
  };
  const auto contradictions = [](const Tracker& its) {
    std::int32_t sum = 0;
    for (const Track& track : its.tracks()) {
      sum += track.is_there() ? track.seen.contradicted : 0;
    }
    return sum;
  };
  std::int32_t contradicted = 0;
  for (int frame = 0; frame < 60; ++frame) {
    at_once.show(tracker);
    in_parts.show(*other);
    ASSERT_EQ(hash_of(tracker), hash_of(*other)) << frame;
    ASSERT_EQ(contradictions(tracker), contradictions(*other)) << frame;
    contradicted += contradictions(tracker);
  }
  EXPECT_GT(claimed, 100);
  EXPECT_GT(contradicted, 10);
}

TEST_F(TrackerOf, NothingSurvivesABreakInTime) {
  struct Break {
    const char* what;
    std::int64_t step_ms;
    bool survives;
  };
  for (const Break its : {Break{"as always", 40, true}, Break{"three turns of 100 ms", 400, true},
                          Break{"the longest step", 450, true}, Break{"a gap", 451, false},
                          Break{"a second", 1'000, false}, Break{"time back", -40, false}}) {
    tracker.forget();
    std::uint64_t ms = 50'000;
    for (std::int32_t x = 0; x < 5; ++x, ms += 40) {
      add_pair(ms, 60 + x);
    }
    std::set<std::uint32_t> before;
    for (const Track& track : tracker.tracks()) {
      before.insert(track.is_there() ? track.id : 0);
    }
    ASSERT_GT(before.size(), 1U);
    const FrameCounts counts =
        add_pair(static_cast<std::uint64_t>(static_cast<std::int64_t>(ms - 40) + its.step_ms),
                 64 + static_cast<std::int32_t>(std::max<std::int64_t>(its.step_ms, 0) / 40));
    EXPECT_EQ(counts.is_forgotten, !its.survives) << its.what;
    bool is_any_kept = false;
    for (const Track& track : tracker.tracks()) {
      is_any_kept = is_any_kept || (track.is_there() && before.contains(track.id));
    }
    EXPECT_EQ(is_any_kept, its.survives) << its.what;
  }
}

TEST_F(TrackerOf, AFrameOfTheSameTimeChangesNothing) {
  for (std::int32_t x = 0; x < 5; ++x) {
    add_pair(50'000 + 40 * static_cast<std::uint64_t>(x), 60 + x);
  }
  const std::uint64_t before = hash_of(tracker);
  EXPECT_EQ(add_pair(50'160, 90), FrameCounts{});
  EXPECT_EQ(hash_of(tracker), before);
}

// Frames in which nobody measured anything are no steps, and a long silence ends all.
TEST_F(TrackerOf, ASilenceOfAllLeavesNoTraceUntilItIsLong) {
  const auto silent = std::make_unique<Tracker>();
  tests::Scene flowing = busy_scene();
  tests::Scene pausing = busy_scene();
  flowing.show_until(2, tracker);
  pausing.show_until(2, *silent, [&] {
    const std::uint64_t before = hash_of(*silent);
    silent->pass(silent->time_us() - 10'000);
    silent->pass(silent->time_us());
    silent->pass(silent->time_us() + 40'000);
    EXPECT_EQ(hash_of(*silent), before);
  });
  EXPECT_EQ(hash_of(*silent), hash_of(tracker));
  const std::uint64_t last_us = tracker.time_us();
  tracker.pass(last_us + 450'000);
  EXPECT_GT(count(tracker), 0U);
  tracker.pass(last_us + 450'001);
  EXPECT_EQ(count(tracker), 0U);
  EXPECT_EQ(tracker.time_us(), 0U);
}

// From 200 ms on, nothing is published and no hit is labelled. The tracks are there again with the
// next frame.
TEST_F(TrackerOf, ALongerSilenceHidesTheObjects) {
  tests::Scene scene = busy_scene();
  scene.show_until(2, tracker);
  const auto labelled = [&] {
    return std::ranges::count_if(tracker.hits(),
                                 [&](const FrameHit& hit) { return tracker.is_moving(hit); });
  };
  const std::uint64_t last_us = tracker.time_us();
  tracker.pass(last_us + 200'000);
  EXPECT_EQ(tracker.time_us(), last_us);
  EXPECT_GT(labelled(), 0);
  const std::size_t tracks = count(tracker);
  tracker.pass(last_us + 200'001);
  EXPECT_EQ(tracker.time_us(), 0U);
  EXPECT_EQ(labelled(), 0);
  EXPECT_EQ(count(tracker), tracks);
  scene.show_until(3, tracker);
  EXPECT_GT(tracker.time_us(), last_us);
  EXPECT_GT(labelled(), 0);
}

// What is not hit any more: young ones end after 0.1 s, all after 0.5 s.
TEST_F(TrackerOf, TracksEndWithoutHits) {
  tests::Scene scene = busy_scene();
  scene.show_until(2, tracker);
  ASSERT_TRUE(std::ranges::any_of(tracker.tracks(), &Track::moves));
  const std::uint64_t last_ms = tests::kStartUs / 1'000 + 2'000;
  for (std::uint64_t ms = 40; ms <= 120; ms += 40) {
    add(last_ms + ms, {});
  }
  EXPECT_TRUE(std::ranges::all_of(
      tracker.tracks(), [](const Track& its) { return !its.is_there() || its.has_moved(); }));
  EXPECT_GT(count(tracker), 0U);
  for (std::uint64_t ms = 160; ms <= 520; ms += 40) {
    add(last_ms + ms, {});
  }
  EXPECT_EQ(count(tracker), 0U);
}

// No id is given twice, also after the tracker has forgotten.
TEST_F(TrackerOf, NoIdComesAgain) {
  Random random(6);
  std::uint32_t newest = 0;
  std::uint64_t ms = 50'000;
  for (int frame = 0; frame < 300; ++frame) {
    ms += 40;
    std::set<std::uint32_t> known;
    for (const Track& track : tracker.tracks()) {
      known.insert(track.is_there() ? track.id : 0);
    }
    if (random.one_in(20)) {
      tracker.forget();
    }
    add_pair(ms, random.between(-300, 300));
    const std::uint32_t before = newest;
    for (const Track& track : tracker.tracks()) {
      if (track.is_there() && !known.contains(track.id)) {
        EXPECT_GT(track.id, before);
        newest = std::max(newest, track.id);
      }
    }
  }
  EXPECT_GT(newest, 100U);
}

// Only a track that is believed to move has a velocity that is believed.
TEST_F(TrackerOf, OnlyWhatMovesHasAVelocity) {
  tests::Scene scene = busy_scene();
  bool is_any_doubted = false;
  scene.show_until(2, tracker, [&] {
    for (const Track& its : tracker.tracks()) {
      if (its.is_there() && !its.moves()) {
        EXPECT_EQ(its.believed_velocity(), Velocity{});
        is_any_doubted = is_any_doubted || its.speed() > 500;
      }
    }
  });
  EXPECT_TRUE(is_any_doubted);
}

// Frames that nobody sees but who wants to break it. All of it is bounded and counted, and
// repeats to the bit.
class Forged : public testing::Test {
 protected:
  template <typename Draw>
  std::size_t expect_bounded(Name name, Draw&& draw) {
    const auto one = std::make_unique<Tracker>();
    const auto again = std::make_unique<Tracker>();
    const Everywhere everywhere{name};
    for (int frame = 0; frame < iog::tests::effort(60, 12); ++frame) {
      const std::vector<Hit> hits = draw(frame);
      const std::uint64_t us = 50'000'000 + 40'000 * static_cast<std::uint64_t>(frame);
      const Frame its{.end_us = us, .car = {}, .area = kArea, .ages_ms = kAges, .hits = hits};
      const FrameCounts counts = one->add(its, GridNames(everywhere));
      EXPECT_EQ(again->add(its, GridNames(everywhere)), counts);
      EXPECT_EQ(hash_of(*one), hash_of(*again));
      EXPECT_LE(one->hits().size(), kMostHits);
      EXPECT_GE(one->hits().size() + counts.hits.beyond, std::min(hits.size(), kMostHits));
      for (const Track& track : one->tracks()) {
        if (track.is_there()) {
          EXPECT_LE(std::abs(track.velocity().x), kMostSpeed);
          EXPECT_LE(std::abs(track.velocity().y), kMostSpeed);
          EXPECT_LE(longest_of(track.box().sides), kNoThingMm);
          EXPECT_LE(track.confidence, kMostConfidence);
        }
      }
    }
    return count(*one);
  }
};

TEST_F(Forged, HitsAnywhere) {
  Random random(7);
  for (const Name name : {Name::kMoving, Name::kStanding, Name::kFree}) {
    expect_bounded(name, [&](int /*frame*/) {
      std::vector<Hit> hits(16'384);
      for (Hit& hit : hits) {
        hit = {.cell = {random.between(-512, 511), random.between(-512, 511)}, .slice = 4};
      }
      return hits;
    });
  }
}

// 1,024 clusters of 16 hits that all move at 5 m/s, in two directions.
TEST_F(Forged, ClustersThatMove) {
  Random random(8);
  std::vector<geometry::Cell> places(1'024);
  for (geometry::Cell& place : places) {
    place = {random.between(-400, 400), random.between(-400, 400)};
  }
  const std::size_t tracks = expect_bounded(Name::kMoving, [&](int frame) {
    std::vector<Hit> hits;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::int32_t way = (i % 2 == 0 ? 2 : -2) * frame;
      for (std::int32_t n = 0; n < 16; ++n) {
        hits.push_back({.cell = {places[i].x + way + n % 4, places[i].y + n / 4}, .slice = 4});
      }
    }
    return hits;
  });
  EXPECT_GT(tracks, kMostTracks / 2);
}

// As many things as there is room for within a few tiles, that jump.
TEST_F(Forged, CrowdsThatJump) {
  Random random(9);
  expect_bounded(Name::kMoving, [&](int frame) {
    std::vector<Hit> hits;
    hits.reserve(800);
    for (std::int32_t i = 0; i < 400; ++i) {
      const std::int32_t off = random.between(-3, 3) + frame % 2;
      hits.push_back({.cell = {off + i % 20 * 7, i / 20 * 7}, .slice = 4});
      hits.push_back({.cell = {off + i % 20 * 7, i / 20 * 7 + 1}, .slice = 3});
    }
    return hits;
  });
}

TEST_F(Forged, EveryCellOfATile) {
  expect_bounded(Name::kMoving, [&](int frame) {
    std::vector<Hit> hits;
    hits.reserve(5'120);
    for (std::int32_t i = 0; i < 5 * 1'024; ++i) {
      hits.push_back(
          {.cell = {i % 32 + frame, i / 32 % 32}, .slice = static_cast<std::uint8_t>(i / 1'024)});
    }
    return hits;
  });
}

}  // namespace
}  // namespace iog::objects
