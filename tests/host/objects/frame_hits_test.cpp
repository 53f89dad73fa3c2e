// Laws of a frame's hits: the order in which they come and repetition do not show, the nearest have
// room first, and what has none is counted.
#include "objects/frame_hits.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <tuple>
#include <vector>

#include "fakes/random.hpp"

namespace iog::objects {
namespace {

using iog::tests::Random;

constexpr std::array<std::uint8_t, 5> kAges{32, 24, 16, 8, 0};
// The car is in the middle of the window, which wraps in its slots.
constexpr window::Area kArea = window::Area::around({5'000, -7'000});
constexpr Point kCar{500'000, -700'000};

std::vector<Hit> random_hits(Random& random, std::size_t count, std::int32_t reach) {
  std::vector<Hit> hits;
  hits.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    hits.push_back(
        {.cell = {5'000 + random.between(-reach, reach), -7'000 + random.between(-reach, reach)},
         .slice = static_cast<std::uint8_t>(random.below(kAges.size()))});
  }
  return hits;
}
void shuffle(std::vector<Hit>& hits, Random& random) {
  for (std::size_t last = hits.size(); last > 1; --last) {
    std::swap(hits[last - 1], hits[random.below(last)]);
  }
}
using Said = std::tuple<std::int32_t, std::int32_t, std::int32_t>;
std::vector<Said> said(const FrameHits& hits) {
  std::vector<Said> all;
  for (const FrameHit& hit : hits.all()) {
    all.emplace_back(hit.cell.x, hit.cell.y, hit.age_ms);
  }
  return all;
}
Frame frame_of(const std::vector<Hit>& hits) {
  return {.end_us = 1, .car = kCar, .area = kArea, .ages_ms = kAges, .hits = hits};
}

class FrameHitsOf : public testing::Test {
 protected:
  std::unique_ptr<FrameHits> owner = std::make_unique<FrameHits>();
  FrameHits& hits = *owner;
};

TEST_F(FrameHitsOf, AnyOrderAndRepetitionAreTheSame) {
  Random random(1);
  for (const std::size_t count : {30U, 3'000U, 20'000U}) {
    std::vector<Hit> all = random_hits(random, count, 400);
    EXPECT_EQ(hits.gather(frame_of(all)).wrong, 0U);
    const std::vector<Said> before = said(hits);
    shuffle(all, random);
    hits.gather(frame_of(all));
    EXPECT_EQ(said(hits), before);
    if (count < 1'000) {
      all.insert(all.end(), all.begin(), all.end());
      EXPECT_EQ(hits.gather(frame_of(all)), FrameHits::Left{});
      EXPECT_EQ(said(hits), before);
    }
  }
}

// Each once, and with the time of its slice.
TEST_F(FrameHitsOf, AllAreThereIfThereIsRoom) {
  Random random(2);
  const std::vector<Hit> all = random_hits(random, 3'000, 500);
  EXPECT_EQ(hits.gather(frame_of(all)), FrameHits::Left{});
  std::set<Said> expected;
  for (const Hit& hit : all) {
    expected.emplace(hit.cell.x, hit.cell.y, kAges[hit.slice]);
  }
  const std::vector<Said> found = said(hits);
  EXPECT_EQ(std::set<Said>(found.begin(), found.end()), expected);
  EXPECT_EQ(found.size(), expected.size());
}

std::int32_t ring_of(geometry::Cell cell) {
  const auto tile = [](std::int32_t its) {
    return static_cast<std::int32_t>(std::floor(its / 32.0));
  };
  return std::max(std::abs(tile(cell.x) - tile(5'000)), std::abs(tile(cell.y) - tile(-7'000)));
}

TEST_F(FrameHitsOf, TheNearestTilesComeFirst) {
  Random random(3);
  const std::vector<Hit> all = random_hits(random, 16'384, 500);
  const FrameHits::Left left = hits.gather(frame_of(all));
  EXPECT_EQ(hits.all().size(), kMostHits);
  EXPECT_GT(left.beyond, 0U);
  std::int32_t farthest = 0;
  for (const FrameHit& hit : hits.all()) {
    ASSERT_GE(ring_of(hit.cell), farthest);
    farthest = ring_of(hit.cell);
  }
  std::set<Said> nearer;
  for (const Hit& hit : all) {
    if (ring_of(hit.cell) < farthest) {
      nearer.emplace(hit.cell.x, hit.cell.y, kAges[hit.slice]);
    }
  }
  const std::vector<Said> found = said(hits);
  const std::set<Said> kept(found.begin(), found.end());
  EXPECT_TRUE(std::ranges::includes(kept, nearer));
}

TEST_F(FrameHitsOf, WhatIsOutsideOrOfNoSliceIsCounted) {
  const std::vector<Hit> all{{.cell = {5'000, -7'000}, .slice = 0},
                             {.cell = {5'000, -7'000}, .slice = 5},
                             {.cell = {5'000, -7'000}, .slice = 255},
                             {.cell = {5'600, -7'000}, .slice = 0},
                             {.cell = {INT32_MIN, INT32_MAX}, .slice = 0}};
  EXPECT_EQ(hits.gather(frame_of(all)), (FrameHits::Left{.beyond = 0, .wrong = 4}));
  EXPECT_EQ(hits.all().size(), 1U);
}

TEST_F(FrameHitsOf, AreFoundByTheirCells) {
  Random random(4);
  hits.gather(frame_of(random_hits(random, 2'000, 60)));
  for (std::int32_t y = -7'062; y <= -6'938; ++y) {
    for (std::int32_t x = 4'938; x <= 5'062; ++x) {
      const auto all = hits.all();
      const auto found = std::ranges::find(all, geometry::Cell{x, y}, &FrameHit::cell);
      ASSERT_EQ(hits.first_of({x, y}), static_cast<std::size_t>(found - all.begin()));
    }
  }
}

}  // namespace
}  // namespace iog::objects
