// When a map counts as contradicted, and when it does not any more.
#include "map/agreement.hpp"

#include <gtest/gtest.h>

namespace iog::map {
namespace {

constexpr std::uint32_t kCellsOfTile = 32 * 32;

window::Plane first_cells(std::uint32_t count) {
  window::Plane plane{};
  for (std::uint32_t cell = 0; cell < count; ++cell) {
    plane[cell / 32] |= 1U << cell % 32;
  }
  return plane;
}

// Rounds of so many free cells, of which so many are inside of buildings.
bool is_contradicted_after(Agreement& agreement, std::uint32_t rounds, std::uint32_t free,
                           std::uint32_t inside, std::int32_t cell_mm = 100) {
  for (std::uint32_t round = 0; round < rounds; ++round) {
    for (std::uint32_t cells = 0; cells < free; cells += kCellsOfTile) {
      const std::uint32_t of_tile = cells < inside ? inside - cells : 0;
      agreement.add(first_cells(free - cells < kCellsOfTile ? free - cells : kCellsOfTile),
                    first_cells(of_tile < kCellsOfTile ? of_tile : kCellsOfTile));
    }
    agreement.end_round(cell_mm);
  }
  return agreement.is_contradicted();
}

TEST(InsideBuildings, AreCellsThatCanBeNothingElse) {
  TileMask mask;
  mask.building[3] = 0xFF;
  mask.road[3] = 0x0F;
  mask.intermediate[3] = 0x30;
  const window::Plane inside = inside_buildings(mask);
  EXPECT_EQ(inside[3], 0xC0U);
  EXPECT_EQ(inside[2], 0U);
}

TEST(Agreement, IsContradictedByBeamsThroughHousesInTwoRounds) {
  Agreement agreement;
  EXPECT_FALSE(is_contradicted_after(agreement, 1, 200'000, 782));
  EXPECT_FALSE(is_contradicted_after(agreement, 1, 200'000, 781)) << "less than 1/256";
  EXPECT_FALSE(is_contradicted_after(agreement, 1, 200'000, 782)) << "not in a row";
  EXPECT_TRUE(is_contradicted_after(agreement, 1, 200'000, 782));
}

TEST(Agreement, NeedsEnoughCells) {
  Agreement agreement;
  EXPECT_FALSE(is_contradicted_after(agreement, 9, 4'999, 4'999)) << "free";
  EXPECT_FALSE(is_contradicted_after(agreement, 9, 20'000, 499)) << "inside";
  EXPECT_TRUE(is_contradicted_after(agreement, 2, 5'000, 500));
  Agreement larger;  // 50 and 5 m2 in cells of 0.2 m
  EXPECT_FALSE(is_contradicted_after(larger, 9, 1'249, 1'249, 200));
  EXPECT_FALSE(is_contradicted_after(larger, 9, 5'000, 124, 200));
  EXPECT_TRUE(is_contradicted_after(larger, 2, 1'250, 125, 200));
}

TEST(Agreement, ComesBackAfterSixteenRoundsThatAgree) {
  Agreement agreement;
  ASSERT_TRUE(is_contradicted_after(agreement, 2, 100'000, 10'000));
  EXPECT_TRUE(is_contradicted_after(agreement, 15, 102'400, 100));
  EXPECT_TRUE(is_contradicted_after(agreement, 1, 102'400, 101)) << "more than 1/1024";
  EXPECT_TRUE(is_contradicted_after(agreement, 15, 102'400, 100));
  EXPECT_TRUE(is_contradicted_after(agreement, 9, 4'999, 0)) << "says nothing, and breaks no row";
  EXPECT_FALSE(is_contradicted_after(agreement, 1, 102'400, 100));
  EXPECT_FALSE(is_contradicted_after(agreement, 1, 100'000, 10'000)) << "from the start";
}

}  // namespace
}  // namespace iog::map
