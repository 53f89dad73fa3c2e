// The law by which a frame can be fused in parts: parts that are fused from zero by hits_win, and
// joined, are the frame.
#include "fusion/joined_grid.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/evidence.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fusion/frame_fusion.hpp"

namespace iog::fusion {
namespace {

using grid::OccupancyIndex;

std::vector<OccupancyIndex> released(JoinedGrid& joined) {
  std::vector<OccupancyIndex> cells(geometry::kCellCount);
  joined.release([&](std::size_t tile, std::span<const std::byte, geometry::kTileCells> bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::size_t x =
          tile % geometry::kTilesPerSide * geometry::kTileSide + i % geometry::kTileSide;
      const std::size_t y =
          tile / geometry::kTilesPerSide * geometry::kTileSide + i / geometry::kTileSide;
      cells[y * geometry::kCellsPerSide + x] = static_cast<OccupancyIndex>(bytes[i]);
    }
  });
  return cells;
}

std::vector<tests::Evidence> points_of_frame(const vehicle::Vehicle& vehicle,
                                             tests::Random& random) {
  std::vector<tests::Evidence> frame = tests::random_frame(random, tests::effort(3000, 400));
  for (tests::Evidence& evidence : frame) {
    evidence.sensor %= vehicle.sensors.size();
  }
  return frame;
}

// Each point is of any part.
std::vector<OccupancyIndex> fused_in_parts(FrameFusion& fusion, const vehicle::Vehicle& vehicle,
                                           std::span<const tests::Evidence> frame,
                                           std::size_t parts, tests::Random& random) {
  std::vector<std::vector<tests::Evidence>> part_of(parts);
  for (const tests::Evidence& evidence : frame) {
    part_of[random.below(parts)].push_back(evidence);
  }
  const auto joined = std::make_unique<JoinedGrid>();
  for (const auto& part : part_of) {
    fusion.clear();
    for (const tests::Evidence& evidence : part) {
      fusion.add(vehicle.sensors[evidence.sensor], evidence.point);
    }
    fusion.finish();
    fusion.release([&](std::size_t tile, auto indexes) { joined->add(tile, indexes); });
  }
  return released(*joined);
}

void expect_that_no_part_shows(const vehicle::Vehicle& vehicle, std::uint64_t seed) {
  tests::Random random(seed);
  const auto fusion = std::make_unique<FrameFusion>(vehicle);
  const auto frame = points_of_frame(vehicle, random);
  for (const tests::Evidence& evidence : frame) {
    fusion->add(vehicle.sensors[evidence.sensor], evidence.point);
  }
  fusion->finish();
  const auto expected = tests::cells_of(*fusion);
  // Cells of all kinds, else the law would be trivial.
  EXPECT_GT(std::ranges::count(expected, OccupancyIndex{-127}), 20);
  EXPECT_GT(std::ranges::count_if(expected, [](int i) { return -127 < i && i < 0; }), 20);
  EXPECT_GT(std::ranges::count_if(expected, [](int i) { return i > 0; }), 20);
  for (const std::size_t parts : {1U, 2U, 7U, 31U}) {
    ASSERT_TRUE(fused_in_parts(*fusion, vehicle, frame, parts, random) == expected) << parts;
  }
}

TEST(JoinedGrid, PartsOfAFrameJoinToTheFrame) {
  expect_that_no_part_shows(tests::OneLux::kVehicle, 821);
  expect_that_no_part_shows(tests::ThreeLux::kVehicle, 822);
  expect_that_no_part_shows(tests::OneLuxNearest::kVehicle, 823);
}

using OneTile = std::array<OccupancyIndex, geometry::kTileCells>;

// A grid in which nothing is known but in tile 5.
void add(JoinedGrid& joined, const OneTile& tile) {
  if (std::ranges::any_of(tile, [](int index) { return index != 0; })) {
    joined.add(5, tile);
  }
}

OccupancyIndex joined_in_integers(std::initializer_list<int> indexes) {
  int hits = 0;
  int free = 0;
  for (const int index : indexes) {
    (index > 0 ? hits : free) += index;
  }
  return static_cast<OccupancyIndex>(hits > 0 ? std::min(hits, 127) : std::max(free, -127));
}

// Every pair of indexes, and a third on top.
TEST(JoinedGrid, HitsWinAndSumsSaturate) {
  const auto joined = std::make_unique<JoinedGrid>();
  for (const int third : {0, -127, -3, 1, 127}) {
    std::vector<std::pair<int, int>> pairs;
    for (int a = -127; a <= 127; ++a) {
      for (int b = -127; b <= 127; ++b) {
        pairs.emplace_back(a, b);
      }
    }
    for (std::size_t first = 0; first < pairs.size(); first += geometry::kTileCells) {
      std::array<OneTile, 3> tiles{};
      for (std::size_t i = 0; i < geometry::kTileCells; ++i) {
        tiles[0][i] = static_cast<OccupancyIndex>(pairs[(first + i) % pairs.size()].first);
        tiles[1][i] = static_cast<OccupancyIndex>(pairs[(first + i) % pairs.size()].second);
        tiles[2][i] = static_cast<OccupancyIndex>(third);
      }
      for (const OneTile& tile : tiles) {
        add(*joined, tile);
      }
      int visits = 0;
      joined->release([&](std::size_t tile, auto bytes) {
        ++visits;
        EXPECT_EQ(tile, 5U);
        for (std::size_t i = 0; i < bytes.size(); ++i) {
          const auto [a, b] = pairs[(first + i) % pairs.size()];
          ASSERT_EQ(static_cast<std::int8_t>(bytes[i]), joined_in_integers({a, b, third}))
              << a << ' ' << b << ' ' << third;
        }
      });
      EXPECT_EQ(visits, 1);
    }
  }
}

// What was released is gone.
TEST(JoinedGrid, ReleasingClears) {
  const auto joined = std::make_unique<JoinedGrid>();
  OneTile tile{};
  tile[7] = 2;
  add(*joined, tile);
  std::set<int> values;
  for (int time = 0; time < 2; ++time) {
    joined->release(
        [&](std::size_t, auto bytes) { values.insert(static_cast<std::int8_t>(bytes[7])); });
    add(*joined, tile);
  }
  EXPECT_EQ(values, std::set<int>{2});
}

}  // namespace
}  // namespace iog::fusion
