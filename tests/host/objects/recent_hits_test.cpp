// What was hit lately, beside a list of all that was ever hit.
#include "objects/recent_hits.hpp"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/random.hpp"

namespace iog::objects {
namespace {

struct Past {
  std::uint64_t epoch;
  geometry::Cell cell;
};

int oldest_of(const std::vector<Past>& past, std::uint64_t now, geometry::Cell cell) {
  std::uint64_t oldest = 0;
  for (const Past& its : past) {
    if (now - its.epoch < 8 && std::abs(its.cell.x - cell.x) <= 1 &&
        std::abs(its.cell.y - cell.y) <= 1) {
      oldest = std::max(oldest, now - its.epoch);
    }
  }
  return static_cast<int>(oldest);
}

bool is_lately(const std::vector<Past>& past, std::uint64_t now, geometry::Cell cell) {
  return std::ranges::any_of(past, [&](const Past& its) {
    return now - its.epoch < 2 && std::abs(its.cell.x - cell.x) <= 1 &&
           std::abs(its.cell.y - cell.y) <= 1;
  });
}

FrameHit hit_at(geometry::Cell cell) {
  FrameHit hit;
  hit.cell = cell;
  return hit;
}

// Cells near one another, with coordinates of both signs, and frames of 40 ms with gaps.
TEST(RecentHits, AreThoseOfTheLastEightEpochs) {
  iog::tests::Random random(1);
  const auto recent = std::make_unique<RecentHits>();
  std::vector<Past> past;
  std::uint64_t now_us = 80'000'000;
  for (int frame = 0; frame < 200; ++frame) {
    now_us += random.one_in(10) ? 500'000U : 40'000U;
    std::vector<FrameHit> hits;
    hits.reserve(20);
    for (int i = 0; i < 20; ++i) {
      const geometry::Cell cell{random.between(-20, 20), random.between(-20, 20)};
      hits.push_back(hit_at(cell));
      past.push_back({now_us / 80'000, cell});
    }
    recent->add(now_us, hits);
    for (int i = 0; i < 100; ++i) {
      const geometry::Cell cell{random.between(-22, 22), random.between(-22, 22)};
      ASSERT_EQ(recent->oldest(cell), oldest_of(past, now_us / 80'000, cell)) << frame;
      ASSERT_EQ(recent->is_hit_lately(cell), is_lately(past, now_us / 80'000, cell)) << frame;
    }
  }
  recent->forget();
  EXPECT_EQ(recent->oldest({0, 0}), 0);
}

// A break of thousands of years is over at once.
TEST(RecentHits, ALongBreakTakesNoLonger) {
  const auto recent = std::make_unique<RecentHits>();
  recent->add(8'000'000, std::vector{hit_at({0, 0})});
  constexpr std::uint64_t kLateUs = std::uint64_t{1} << 62;
  recent->add(kLateUs, std::vector{hit_at({50, 50})});
  EXPECT_EQ(recent->oldest({0, 0}), 0);
  recent->add(kLateUs + 160'000, {});
  EXPECT_EQ(recent->oldest({50, 50}), 2);
}

// As many as two full frames of an epoch are remembered, and more do no harm.
TEST(RecentHits, HaveABound) {
  const auto recent = std::make_unique<RecentHits>();
  constexpr std::int32_t kMany = 2 * static_cast<std::int32_t>(kMostHits) + 1'000;
  std::vector<FrameHit> hits(kMany);
  for (std::int32_t i = 0; i < kMany; ++i) {
    hits[static_cast<std::size_t>(i)] = hit_at({i % 1'000, 3 * (i / 1'000)});
  }
  recent->add(8'000'000, hits);
  recent->add(8'160'000, {});
  EXPECT_EQ(recent->oldest({0, 0}), 2);
  EXPECT_EQ(recent->oldest(hits.back().cell), 0);
  recent->add(9'000'000, {});
  EXPECT_EQ(recent->oldest({0, 0}), 0);
}

}  // namespace
}  // namespace iog::objects
