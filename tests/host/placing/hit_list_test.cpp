// The hits of a frame as a list: each hit of each slice, where its cell's centre lies.
#include "placing/hit_list.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <tuple>
#include <vector>

#include "fakes/random.hpp"
#include "placing/exact_place.hpp"
#include "placing/slice.hpp"

namespace iog::placing {
namespace {

using tests::Slice;
using Said = std::tuple<std::int32_t, std::int32_t, int>;

Slice some_hits(tests::Random& random) {
  Slice slice;
  for (int i = 0; i < 400; ++i) {
    slice.set({random.between(0, 1023), random.between(0, 1023)}, random.between(-14, 14));
  }
  return slice;
}

std::vector<Said> sorted(std::vector<Said> said) {
  std::ranges::sort(said);
  return said;
}

// Those of which rational numbers say where they lie. A hit too near to a border of cells for that
// may be in either, and is left out on both sides by `unclear`.
TEST(HitList, HasEachHitOfEachSliceThatLiesInTheWindow) {
  tests::Random random(31);
  const window::Area area({-16, -16});
  for (int trial = 0; trial < 20; ++trial) {
    const auto list = std::make_unique<HitList>();
    std::vector<Said> expected;
    std::size_t unclear = 0;
    for (std::uint8_t number = 0; number < 3; ++number) {
      const Slice slice = some_hits(random);
      const Placement at = tests::placed(random.between(-9'000, 9'000),
                                         random.between(-9'000, 9'000), random.between(0, 359));
      slice.for_each([&](geometry::Cell cell, int index) {
        const tests::ExactPoint exact = tests::exact_in_frame(cell, at);
        if (index > 0 && !exact.is_clear()) {
          ++unclear;
        } else if (index > 0 && area.contains(exact.cell())) {
          expected.emplace_back(exact.cell().x, exact.cell().y, number);
        }
      });
      const auto cells = std::make_unique<SliceCells>();
      tests::hand_over(slice, *cells);
      const PlacedCells placed{.cells = cells.get(), .at = at, .number = number};
      list->add(std::span(&placed, 1), area);
    }
    std::vector<Said> found;
    for (const Hit& hit : list->all()) {
      found.emplace_back(hit.cell.x, hit.cell.y, hit.slice);
    }
    EXPECT_GT(expected.size(), 300U);
    EXPECT_LE(found.size(), expected.size() + unclear);
    EXPECT_TRUE(std::ranges::includes(sorted(found), sorted(expected)));
    EXPECT_EQ(list->left(), 0U);
    list->clear();
    EXPECT_TRUE(list->all().empty());
  }
}

// A slice that is hit everywhere has more cells than there is room for.
TEST(HitList, WhatHasNoRoomIsCounted) {
  Slice slice;
  for (std::int32_t y = 200; y < 400; ++y) {
    for (std::int32_t x = 200; x < 400; ++x) {
      slice.set({x, y}, 14);
    }
  }
  const auto cells = std::make_unique<SliceCells>();
  tests::hand_over(slice, *cells);
  const PlacedCells placed{.cells = cells.get(), .at = tests::placed(0, 0)};
  const auto list = std::make_unique<HitList>();
  list->add(std::span(&placed, 1), window::Area({-16, -16}));
  EXPECT_EQ(list->all().size(), HitList::kMost);
  EXPECT_EQ(list->left(), 40'000U - HitList::kMost);
}

}  // namespace
}  // namespace iog::placing
