// Edges, beside means in floating point, and the box's own where nothing counts.
#include "objects/edges.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::objects {
namespace {

struct Mean {
  double mm;
  std::int32_t hits;
};

// Of the places that are within 250 mm of one of them.
Mean mean_near(const std::vector<std::int32_t>& places, std::int32_t outermost) {
  double sum = 0;
  std::int32_t count = 0;
  for (const std::int32_t place : places) {
    if (std::abs(place - outermost) <= 250) {
      sum += place;
      ++count;
    }
  }
  return {.mm = sum / count, .hits = count};
}

// A mean of whole millimetres is less than one beside that of all digits.
void expect_edges(const Ends& ends, const std::vector<std::int32_t>& places) {
  const Mean low = mean_near(places, *std::ranges::min_element(places));
  const Mean high = mean_near(places, *std::ranges::max_element(places));
  ASSERT_LT(std::abs(ends.low.mm - low.mm), 1);
  ASSERT_EQ(ends.low.hits, low.hits);
  ASSERT_LT(std::abs(ends.high.mm - high.mm), 1);
  ASSERT_EQ(ends.high.hits, high.hits);
}

TEST(EdgesOf, AreMeansOfTheHitsWithinAQuarterOfAMetreOfTheOutermost) {
  iog::tests::Random random(1);
  for (int i = 0; i < iog::tests::effort(3'000, 200); ++i) {
    const Box box{.at = {random.between(-90'000, 90'000), random.between(-90'000, 90'000)},
                  .along = {0, 1 << kDirectionBits}};
    std::vector<FrameHit> hits(1 + random.below(12));
    std::vector<std::int32_t> along;
    std::vector<std::int32_t> across;
    for (FrameHit& hit : hits) {
      const std::int32_t a = random.between(-700, 700);
      const std::int32_t b = random.between(-700, 700);
      // To the left of what heads to y is -x.
      hit.moved = {box.at.x_mm - b, box.at.y_mm + a};
      hit.stands = along.size() > 1 && random.one_in(4);
      if (!hit.stands) {
        along.push_back(a);
        across.push_back(b);
      }
    }
    std::vector<std::uint16_t> numbers(hits.size());
    std::iota(numbers.begin(), numbers.end(), std::uint16_t{0});
    const Edges edges = edges_of(box, numbers, hits);
    expect_edges(edges[kAlong], along);
    expect_edges(edges[kAcross], across);
  }
}

// A parked car's hits say nothing of what passes it.
TEST(EdgesOf, AreTheBoxesOwnIfAllHitsStand) {
  const Box box{.sides = {Interval{-2000, 2500}, Interval{-900, 850}}};
  const std::vector<FrameHit> hits{{.moved = {9'000, 9'000}, .stands = true}};
  const std::vector<std::uint16_t> numbers{0};
  for (const Edges& edges : {edges_of(box, numbers, hits), edges_of(box, {}, hits)}) {
    for (const Side side : kSides) {
      EXPECT_EQ(edges[side].low.mm, box.sides[side].low);
      EXPECT_EQ(edges[side].high.mm, box.sides[side].high);
    }
  }
}

}  // namespace
}  // namespace iog::objects
