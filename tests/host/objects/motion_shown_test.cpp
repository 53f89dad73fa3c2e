// What places say of a track, row by row of the table in docs/objects.md, "Judge".
#include "objects/motion_shown.hpp"

#include <array>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace iog::objects {
namespace {

constexpr std::uint64_t kThenUs = 1'000'000'000;
constexpr std::uint64_t kNowUs = kThenUs + 200'000;
constexpr geometry::Cell kLeft{80, 5};
constexpr geometry::Cell kReached{135, 5};
constexpr Point kCarBehind{0, 0};
constexpr Point kCarAhead{30'000, 500};
constexpr Velocity kAtRest{};

// A grid that calls a cell and those around it the same.
struct AllAlike {
  decision::Class its = decision::Class::kFree;
  [[nodiscard]] Names names_around(geometry::Cell /*cell*/) const {
    return Names(1U << static_cast<unsigned>(its));
  }
  [[nodiscard]] CellName look_at(geometry::Cell /*cell*/) const {
    return {.name = name_of(its), .is_open = false};
  }
};

// A frame's hits of its last slice, each with the same name.
std::unique_ptr<FrameHits> hits_of(const std::vector<geometry::Cell>& cells, Point car,
                                   const FrameHit& each = {}) {
  constexpr std::array<std::uint8_t, 1> kAges{0};
  std::vector<Hit> given;
  for (const geometry::Cell cell : cells) {
    given.push_back({.cell = cell, .slice = 0});
  }
  auto hits = std::make_unique<FrameHits>();
  hits->gather({.end_us = kNowUs,
                .car = car,
                .area = window::Area::around({0, 0}),
                .ages_ms = kAges,
                .hits = given});
  for (FrameHit& hit : hits->all()) {
    hit.name = each.name;
    hit.is_open = each.is_open;
  }
  return hits;
}

std::unique_ptr<RecentHits> nothing_before() { return std::make_unique<RecentHits>(); }

// Where a cell was hit 0.2 s ago, and another one is hit now: the track was 2 m by 1 m at 8 m, and
// is at 12 m with 20 m/s.
Seen seen_of(decision::Class grid, const FrameHit& hit, Point car, Velocity car_velocity) {
  const Sides sides{Interval{0, 2'000}, Interval{0, 1'000}};
  Track track;
  track.begin(1, {.at = {12'000, 0}, .sides = sides}, kThenUs);
  track.correct(kAlong, {.place = 0, .speed = 1 << 16}, 20'000);
  Snapshot& then = track.snapshots.begin(kThenUs, {.at = {8'000, 0}, .sides = sides});
  then.cells[then.count++] = kLeft;
  const auto hits = hits_of({kReached}, car, hit);
  constexpr std::array<std::uint16_t, 1> kNumbers{0};
  const AllAlike alike{grid};
  weigh_motion(kNowUs, {car, car_velocity}, kNumbers, {*hits, *nothing_before(), hits->all()},
               GridNames(alike), track);
  return track.seen;
}

// The rear of a car, 1.8 m wide, has gone from x = 8 m to 12 m, straight away from the car at 0.
// Its cells now, and what else is hit.
constexpr std::array<std::int32_t, 3> kAcrossIts{-4, 0, 4};

Seen seen_of_receding(decision::Class grid, const std::vector<geometry::Cell>& others = {},
                      const std::vector<std::int32_t>& rear = {-9, -5, -1, 3, 7},
                      const std::vector<geometry::Cell>& frame_before = {}, std::int32_t place = 80,
                      std::int32_t speed = 20'000) {
  const std::uint64_t then_us = speed < 3'000 ? kNowUs - 600'000 : kThenUs;
  const Sides sides{Interval{0, 400}, Interval{-900, 900}};
  Track track;
  track.begin(1, {.at = {12'000, 50}, .sides = sides}, then_us);
  track.correct(kAlong, {.place = 0, .speed = 1 << 16}, speed);
  track.look_from(kCarBehind);
  EXPECT_TRUE(track.is_receding);
  Snapshot& then = track.snapshots.begin(then_us, {.at = {8'000, 50}, .sides = sides});
  for (const std::int32_t y : kAcrossIts) {
    then.cells[then.count++] = {place, y};
  }
  std::vector<geometry::Cell> cells = others;
  for (const std::int32_t y : rear) {
    cells.push_back({121, y});
  }
  const auto hits = hits_of(cells, kCarBehind);
  const auto recent = nothing_before();
  recent->add(kNowUs - 80'000, hits_of(frame_before, kCarBehind)->all());
  recent->add(kNowUs, hits->all());
  std::vector<std::uint16_t> own;
  for (std::uint16_t i = 0; i < hits->all().size(); ++i) {
    if (hits->all()[i].cell.x == 121) {
      own.push_back(i);
    }
  }
  const AllAlike alike{grid};
  weigh_motion(kNowUs, {kCarBehind, kAtRest}, own, {*hits, *recent, hits->all()}, GridNames(alike),
               track);
  return track.seen;
}

struct Said {
  std::int32_t good;
  std::int32_t bad;
  std::int32_t neutral;
  friend bool operator==(const Said&, const Said&) = default;
};
Said said(const Seen& seen) { return {seen.good, seen.bad, seen.neutral}; }

// The hit of now is unknown, and so neutral.
TEST(WeighMotion, APlaceThatItHasLeft) {
  using decision::Class;
  const auto left = [](Class grid, Point car, Velocity car_velocity = kAtRest) {
    return said(seen_of(grid, {}, car, car_velocity));
  };
  EXPECT_EQ(left(Class::kFree, kCarBehind), (Said{1, 0, 1}));
  EXPECT_EQ(left(Class::kUnknown, kCarBehind), (Said{0, 0, 2}));
  EXPECT_EQ(left(Class::kMoving, kCarBehind), (Said{0, 0, 2}));
  EXPECT_EQ(left(Class::kOccupied, kCarBehind), (Said{0, 1, 1}));
  EXPECT_EQ(left(Class::kStopped, kCarBehind), (Said{0, 1, 1}));
  // Hidden behind the thing itself, if open ground counts: not of what goes with the car.
  EXPECT_EQ(left(Class::kOccupied, kCarAhead), (Said{0, 0, 2}));
  EXPECT_EQ(left(Class::kOccupied, kCarAhead, {20'000, 0}), (Said{0, 1, 1}));
  EXPECT_EQ(left(Class::kStopped, kCarAhead), (Said{0, 1, 1}));
}

// The place that it has left is unknown, and so neutral.
TEST(WeighMotion, APlaceThatItHasComeTo) {
  const auto reached = [](Name name, bool is_open, Velocity car_velocity = kAtRest) {
    return said(seen_of(decision::Class::kUnknown, {.name = name, .is_open = is_open}, kCarBehind,
                        car_velocity));
  };
  EXPECT_EQ(reached(Name::kMoving, false), (Said{1, 0, 1}));
  EXPECT_EQ(reached(Name::kOccupied, true), (Said{1, 0, 1}));
  EXPECT_EQ(reached(Name::kOccupied, false), (Said{0, 0, 2}));
  EXPECT_EQ(reached(Name::kStanding, false), (Said{0, 1, 1}));
  // 0 < v e < 1.5 e^2: 20 m/s of a car with 14 and with 13 m/s.
  EXPECT_EQ(reached(Name::kOccupied, true, {14'000, 0}), (Said{0, 0, 2}));
  EXPECT_EQ(reached(Name::kOccupied, true, {13'000, 0}), (Said{1, 0, 1}));
  EXPECT_EQ(reached(Name::kOccupied, true, {-14'000, 0}), (Said{1, 0, 1}));
}

// The grid's names lag behind: that the beams to the rear pass where it was says that it is free.
TEST(WeighTrail, PlacesThatItsOwnBeamsPassAreLeft) {
  for (const auto grid : {decision::Class::kOccupied, decision::Class::kStopped}) {
    const Seen seen = seen_of_receding(grid);
    EXPECT_EQ(seen.passed, 3);
    EXPECT_EQ(seen.kept, 0);
    EXPECT_EQ(said(seen), (Said{3, 0, 0}));
  }
}

// Something stands where it was, or close to that.
TEST(WeighTrail, APlaceThatIsHitAgainIsNotLeft) {
  const Seen seen = seen_of_receding(decision::Class::kOccupied, {{79, 1}});
  EXPECT_EQ(seen.passed, 2);
  EXPECT_EQ(seen.kept, 1);
  EXPECT_EQ(seen.bad, 1);
}

// A unit that scans its layers in turn does not hit the place in this frame, but 80 ms before. At 2
// m/s the rear was 0.52 m nearer 0.26 s ago, so hits so close behind it may be its own. At 20 m/s
// any may be.
TEST(WeighTrail, APlaceThatWasHitLatelyIsNotLeft) {
  const auto kept = [](std::int32_t place, std::int32_t speed) {
    return seen_of_receding(decision::Class::kOccupied, {}, {-9, -5, -1, 3, 7}, {{place, 1}}, place,
                            speed)
        .kept;
  };
  EXPECT_EQ(kept(111, 2'000), 1);
  EXPECT_EQ(kept(113, 2'000), 0);
  EXPECT_EQ(kept(80, 20'000), 0);
}

// Beams that graze a wall pass a place on one side.
TEST(WeighTrail, BeamsOnOneSideAloneSayNothing) {
  const Seen seen = seen_of_receding(decision::Class::kOccupied, {}, {14, 16, 18});
  EXPECT_EQ(seen.passed, 0);
  EXPECT_EQ(seen.good, 0);
}

// Three places passed in a frame are a trail from the second such frame on; one that is hit again
// outweighs three of them.
TEST(Track, HasATrailAfterTwoFramesOfIt) {
  Track track;
  track.begin(1, {}, kThenUs);
  track.seen.passed = 3;
  track.follow_trail();
  EXPECT_FALSE(track.has_trail());
  track.follow_trail();
  EXPECT_TRUE(track.has_trail());
  track.seen.kept = 1;
  track.follow_trail();
  EXPECT_FALSE(track.has_trail());
}

// By more than half of its speed, from 0.6 m/s on: within 60 degrees of the line of sight.
TEST(Track, RecedesWithin60DegreesOfTheLineOfSight) {
  const auto recedes = [](std::int32_t speed, Point at) {
    Track track;
    track.begin(1, {.at = at, .sides = {Interval{0, 1'000}, Interval{0, 1'000}}}, kThenUs);
    track.correct(kAlong, {.place = 0, .speed = 1 << 16}, speed);
    track.look_from({});
    return track.is_receding;
  };
  EXPECT_TRUE(recedes(600, {10'000, 0}));
  EXPECT_FALSE(recedes(590, {10'000, 0}));
  EXPECT_FALSE(recedes(-5'000, {10'000, 0}));
  EXPECT_TRUE(recedes(5'000, {10'000, 16'000}));   // 58 degrees
  EXPECT_FALSE(recedes(5'000, {10'000, 19'500}));  // 63
}

// "Good >= 3 (or as many as there are hits, 2 at least), good >= 4 bad, 2 good >= neutral."
TEST(IsShown, ByTheGoodTheBadAndTheNeutral) {
  const auto shown = [](std::int32_t hits, Said its) {
    return is_shown({.hits = hits, .good = its.good, .bad = its.bad, .neutral = its.neutral});
  };
  EXPECT_TRUE(shown(9, {3, 0, 0}));
  EXPECT_FALSE(shown(9, {2, 0, 0}));
  EXPECT_TRUE(shown(2, {2, 0, 0}));
  EXPECT_FALSE(shown(1, {1, 0, 0}));
  EXPECT_TRUE(shown(9, {8, 2, 0}));
  EXPECT_FALSE(shown(9, {7, 2, 0}));
  EXPECT_TRUE(shown(9, {3, 0, 6}));
  EXPECT_FALSE(shown(9, {3, 0, 7}));
}

// With frames of 40 ms, too, in which each second one is due.
TEST(Remember, FarEnoughBackForTheSlowest) {
  const auto hits = hits_of({kLeft}, kCarBehind);
  constexpr std::array<std::uint16_t, 1> kNumbers{0};
  Track track;
  track.begin(1, {}, kThenUs);
  for (std::uint64_t now_us = kThenUs; now_us < kThenUs + 2'000'000; now_us += 40'000) {
    const std::uint64_t after_us = std::uint64_t{kShownMostMs} * 1000;
    const Snapshot* const then = track.snapshots.youngest_before(now_us - after_us);
    EXPECT_EQ(then != nullptr, now_us >= kThenUs + after_us) << now_us;
    remember(now_us, kNumbers, hits->all(), track);
  }
}

// Standing hits that a track has released are counted as seen, but they are none of its cells.
TEST(Remember, TwelveCellsOfTheHitsThatItHas) {
  Track track;
  track.begin(1, {.at = {8'000, 0}, .sides = {Interval{0, 2'000}, Interval{0, 1'000}}}, kThenUs);
  track.correct(kAlong, {.place = 0, .speed = 1 << 16}, 5'000);
  track.look_from(kCarBehind);
  ASSERT_TRUE(track.may_have_a_standing_face());
  std::vector<geometry::Cell> cells;
  std::vector<std::uint16_t> numbers;
  for (std::int32_t i = 0; i < 48; ++i) {
    cells.push_back({80 + i % 8, i / 8});
    numbers.push_back(static_cast<std::uint16_t>(i));
  }
  track.seen.hits = 48;
  track.seen.standing = 135;
  const auto hits = hits_of(cells, kCarBehind);
  remember(kThenUs, numbers, hits->all(), track);
  ASSERT_NE(track.snapshots.youngest_before(kThenUs), nullptr);
  EXPECT_EQ(track.snapshots.youngest_before(kThenUs)->count, 12U);
}

}  // namespace
}  // namespace iog::objects
