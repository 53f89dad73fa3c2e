// What is left in clusters becomes a track: docs/objects.md, "Cluster".
#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "objects/tracker.hpp"

namespace iog::objects {
namespace {

constexpr std::array<std::uint8_t, 1> kOfNow{0};
constexpr window::Area kNearby = window::Area::around({0, 0});

// A grid that calls the cells of even x moving, and knows nothing else.
struct EvenMoves {
  [[nodiscard]] Names names_around(geometry::Cell /*cell*/) const { return {}; }
  [[nodiscard]] CellName look_at(geometry::Cell cell) const {
    return {.name = cell.x % 2 == 0 ? Name::kMoving : Name::kUnknown};
  }
};

std::vector<Track> born_of(const std::vector<geometry::Cell>& cells) {
  const auto tracker = std::make_unique<Tracker>();
  std::vector<Hit> hits;
  hits.reserve(cells.size());
  for (const geometry::Cell& cell : cells) {
    hits.push_back({.cell = cell});
  }
  const EvenMoves grid;
  tracker->add({.end_us = 1'000'000, .car = {}, .area = kNearby, .ages_ms = kOfNow, .hits = hits},
               GridNames(grid));
  std::vector<Track> born;
  std::ranges::copy_if(tracker->tracks(), std::back_inserter(born), &Track::is_there);
  return born;
}

// From cell 20 on, a cell every 0.3 m and one at the end.
std::vector<geometry::Cell> row_of(std::int32_t length_cells, bool along_x) {
  std::vector<geometry::Cell> cells;
  for (std::int32_t at = 0; at < length_cells; at += 3) {
    cells.push_back(along_x ? geometry::Cell{20 + at, 30} : geometry::Cell{30, 20 + at});
  }
  cells.push_back(along_x ? geometry::Cell{20 + length_cells, 30}
                          : geometry::Cell{30, 20 + length_cells});
  return cells;
}

TEST(Birth, IsOfTwoHits) {
  EXPECT_TRUE(born_of({{30, 30}}).empty());
  const std::vector<Track> born = born_of({{30, 30}, {31, 30}});
  ASSERT_EQ(born.size(), 1U);
  EXPECT_EQ(born[0].speed(), 0);
  EXPECT_EQ(born[0].speed_deviation(), 14'142);  // 10 m/s both ways
}

// Its own hits, and those of them that the grid calls moving, count in the frame of its birth.
TEST(Birth, ItsHitsAreSeen) {
  const std::vector<Track> born = born_of({{30, 30}, {31, 30}, {32, 30}, {33, 30}, {34, 30}});
  ASSERT_EQ(born.size(), 1U);
  EXPECT_EQ(born[0].seen.hits, 5);
  EXPECT_EQ(born[0].seen.moving, 3);
}

TEST(Birth, AThingIsAtMostEighteenMetresLong) {
  for (const bool along_x : {true, false}) {
    EXPECT_EQ(born_of(row_of(180, along_x)).size(), 1U);
    EXPECT_EQ(born_of(row_of(181, along_x)).size(), 0U);
  }
}

}  // namespace
}  // namespace iog::objects
