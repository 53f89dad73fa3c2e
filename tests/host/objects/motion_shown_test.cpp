// What places say of a track, row by row of the table in docs/objects.md, "Judge".
#include "objects/motion_shown.hpp"

#include <array>
#include <cstdint>
#include <gtest/gtest.h>

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

// Where a cell was hit 0.2 s ago, and another one is hit now: the track was 2 m by 1 m at 8 m, and
// is at 12 m with 20 m/s.
Seen seen_of(decision::Class grid, const FrameHit& hit, Point car, Velocity car_velocity) {
  const Sides sides{Interval{0, 2'000}, Interval{0, 1'000}};
  Track track;
  track.begin(1, {.at = {12'000, 0}, .sides = sides}, kThenUs);
  track.correct(kAlong, {.place = 0, .speed = 1 << 16}, 20'000);
  Snapshot& then = track.snapshots.begin(kThenUs, {.at = {8'000, 0}, .sides = sides});
  then.cells[then.count++] = kLeft;
  std::array hits{hit};
  hits[0].cell = kReached;
  constexpr std::array<std::uint16_t, 1> kNumbers{0};
  const AllAlike alike{grid};
  weigh_motion(kNowUs, car, car_velocity, kNumbers, hits, GridNames(alike), track);
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

}  // namespace
}  // namespace iog::objects
