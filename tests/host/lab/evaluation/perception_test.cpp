#include "lab/evaluation/perception.hpp"

#include "gtest/gtest.h"

namespace iog::lab {
namespace {

constexpr std::size_t kSide = 16;
constexpr geometry::Cell kFirst{-100, 7};  // the window's lowest cell

// Bytes of docs/spec.md 3.9: eight times the class, plus how sure it is.
constexpr std::int8_t kFreeByte = 3 * 8 + 5;
constexpr std::int8_t kMovingByte = 4 * 8;
constexpr std::int8_t kOpenByte = 8 * 8 + 7;

std::vector<std::int8_t> window_with(geometry::Cell at, std::int8_t class_byte) {
  std::vector<std::int8_t> classes(kSide * kSide, kFreeByte);
  classes[static_cast<std::size_t>(at.y) * kSide + static_cast<std::size_t>(at.x)] = class_byte;
  return classes;
}

geometry::Cell local(std::int32_t x, std::int32_t y) { return {kFirst.x + x, kFirst.y + y}; }

TEST(SaidBy, ClassesOfOneMeaningAreOne) {
  EXPECT_EQ(said_by(0), Said::kUnknown);
  for (const std::int8_t drivable_to_free : std::array<std::int8_t, 3>{8, 16, 24}) {
    EXPECT_EQ(said_by(drivable_to_free), Said::kFree);
  }
  EXPECT_EQ(said_by(kMovingByte), Said::kMoving);
  for (const std::int8_t standing : std::array<std::int8_t, 3>{40, 55, 63}) {
    EXPECT_EQ(said_by(standing), Said::kStanding);
  }
  EXPECT_EQ(said_by(kOpenByte), Said::kOpen);
}

// A cell that was hit in the newest frames.
RecentHits hit_in(std::size_t frames, geometry::Cell cell) {
  RecentHits hits;
  for (std::size_t i = 0; i < frames; ++i) {
    hits.add_frame({{.cell = cell, .kind = 5}});
  }
  return hits;
}

TEST(RecentHits, AHitIsKeptByAnOccupiedCellWithinTwo) {
  const RecentHits hits = hit_in(3, local(8, 8));
  for (std::int32_t away = 0; away <= 4; ++away) {
    const RecentHits::Kept found =
        hits.compare(window_with({8 + away, 8 - away}, kOpenByte), kSide, kFirst);
    EXPECT_EQ(found.cells[5], 1U);
    EXPECT_EQ(found.kept[5], away <= 2 ? 1U : 0U) << away;
    EXPECT_EQ(found.all_cells(), 1U);
    EXPECT_EQ(found.all_kept(), found.kept[5]);
    EXPECT_EQ(found.freed[5], 1U - found.kept[5]);
  }
}

TEST(RecentHits, WhatIsUnknownIsNeitherKeptNorFreed) {
  const std::vector<std::int8_t> unknown(kSide * kSide);
  const RecentHits::Kept found = hit_in(3, local(8, 8)).compare(unknown, kSide, kFirst);
  EXPECT_EQ(found.all_cells(), 1U);
  EXPECT_EQ(found.all_kept(), 0U);
  EXPECT_EQ(found.freed[5], 0U);
}

TEST(RecentHits, ThreeFramesOfTwelveMakeAThing) {
  const auto nothing = window_with({0, 0}, kFreeByte);
  EXPECT_EQ(hit_in(2, local(8, 8)).compare(nothing, kSide, kFirst).all_cells(), 0U);
  RecentHits hits = hit_in(3, local(8, 8));
  for (int frames_after = 0; frames_after <= 12; ++frames_after) {
    EXPECT_EQ(hits.compare(nothing, kSide, kFirst).all_cells(), frames_after <= 9 ? 1U : 0U);
    hits.add_frame({});
  }
}

// Three cells of a 5 x 5, one a frame, are three frames of each; a cell three away is none of it.
TEST(RecentHits, HitsNearbyAreHitsOfTheSameThing) {
  RecentHits hits;
  for (const std::int32_t x : {6, 8, 7}) {
    hits.add_frame({{.cell = local(x, 8)}});
  }
  const auto nothing = window_with({0, 0}, kFreeByte);
  EXPECT_EQ(hits.compare(nothing, kSide, kFirst).all_cells(), 3U);
  hits.forget();
  for (const std::int32_t x : {5, 8, 11}) {
    hits.add_frame({{.cell = local(x, 8)}});
  }
  EXPECT_EQ(hits.compare(nothing, kSide, kFirst).all_cells(), 0U);
}

TEST(RecentHits, AHitOutsideOfTheWindowDoesNotCount) {
  const auto nothing = window_with({0, 0}, kFreeByte);
  for (const geometry::Cell cell : {local(-1, 8), local(1, 8), local(8, 14), local(8, 4000)}) {
    EXPECT_EQ(hit_in(3, cell).compare(nothing, kSide, kFirst).all_cells(), 0U);
  }
}

GapCounts gaps_by_definition(const std::vector<std::int8_t>& cells, const GapRange& range) {
  constexpr auto kEnd = static_cast<std::int32_t>(kSide);
  const auto is_known = [&](std::int32_t x, std::int32_t y) {
    return x >= 0 && y >= 0 && x < kEnd && y < kEnd &&
           cells[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)] != 0;
  };
  const auto sees = [&](std::int32_t x, std::int32_t y, std::int32_t dx, std::int32_t dy) {
    bool found = false;
    for (std::int32_t step = 0; step <= static_cast<std::int32_t>(range.reach); ++step) {
      found = found || is_known(x + step * dx, y + step * dy);
    }
    return found;
  };
  GapCounts counts;
  for (std::int32_t y = 0; y < kEnd; ++y) {
    for (std::int32_t x = 0; x < kEnd; ++x) {
      const std::int32_t dx = x - range.middle.x;
      const std::int32_t dy = y - range.middle.y;
      if (dx * dx + dy * dy >= range.far_cells * range.far_cells &&
          ((sees(x, y, 1, 0) && sees(x, y, -1, 0)) || (sees(x, y, 0, 1) && sees(x, y, 0, -1)))) {
        ++counts.between;
        counts.unknown += is_known(x, y) ? 0U : 1U;
      }
    }
  }
  return counts;
}

TEST(GapsIn, AreUnknownCellsWithKnownOnesOnTwoSides) {
  std::uint32_t state = 1;
  std::uint64_t unknown = 0;
  for (int sample = 0; sample < 50; ++sample) {
    std::vector<std::int8_t> cells(kSide * kSide);
    for (std::int8_t& cell : cells) {
      state = state * 1'664'525 + 1'013'904'223;
      cell = (state >> 28) == 0 ? kFreeByte : std::int8_t{0};
    }
    const GapRange range{.reach = static_cast<std::size_t>(sample % 5 + 1),
                         .middle = {sample % 16, 3},
                         .far_cells = 6};
    const GapCounts found = gaps_in(cells, kSide, range);
    EXPECT_EQ(found, gaps_by_definition(cells, range));
    unknown += found.unknown;
  }
  EXPECT_GT(unknown, 400U);
}

}  // namespace
}  // namespace iog::lab
