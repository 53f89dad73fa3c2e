// The datagrams of a scan say what they cover: a lost one leaves its own directions unwatched.
#include "tools/formats/points/turn_sectors.hpp"

#include <algorithm>

#include "gtest/gtest.h"

#include "lidar/points.hpp"

namespace iog::tools {
namespace {

using lidar::PointsPacket;

constexpr std::int64_t kTurn = PointsPacket::kPartsPerTurn;
constexpr std::int64_t kDegree = PointsPacket::kPartsPerDegree;
constexpr std::size_t kMost = PointsPacket::kMostPoints;
constexpr PointsSector kWhole{.begin = kTurn / 2, .width = kTurn};

// One point for each step of 0.2 degrees for which `returns`, in the order of the turn. Even points
// are of a laser that looks 4 degrees to the left of the others.
template <typename Returns>
std::vector<WirePoint> turn(std::int64_t begin_deg, bool clockwise, const Returns& returns) {
  std::vector<WirePoint> points;
  for (std::int64_t step = 0; step < 1800; ++step) {
    const std::int64_t turned = step * kDegree / 5;
    const std::int64_t aside = step % 2 == 0 ? 4 * kDegree : 0;
    const std::int64_t azimuth =
        ((begin_deg * kDegree + (clockwise ? -turned : turned) + aside) % kTurn + kTurn) % kTurn;
    if (returns(azimuth / kDegree)) {
      points.push_back({.first = static_cast<std::int32_t>(azimuth)});
    }
  }
  return points;
}

bool covers(const PointsSector& sector, std::int64_t azimuth) {
  return (azimuth - std::int64_t{sector.begin} + kTurn) % kTurn <= std::int64_t{sector.width};
}

bool all_around(std::int64_t /*degree*/) { return true; }
// Nothing comes back from a fifth of the directions, among them those at which the turn begins.
bool but_open_sky(std::int64_t degree) { return degree < 60 || degree >= 132; }

class TurnSectors : public ::testing::TestWithParam<bool> {};

TEST_P(TurnSectors, ContainTheirPointsAndTheWholeTurn) {
  for (const std::int64_t begin_deg : {0, 100, 181, 359}) {
    for (const auto& returns : {all_around, but_open_sky}) {
      const std::vector<WirePoint> points = turn(begin_deg, GetParam(), returns);
      const std::vector<PointsSector> sectors = sectors_of_scan(points, kMost, kWhole);
      ASSERT_EQ(sectors.size(), (points.size() + kMost - 1) / kMost);
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_TRUE(covers(sectors[i / kMost], points[i].first)) << i;
      }
      for (std::int64_t azimuth = 0; azimuth < kTurn; azimuth += kDegree / 4) {
        EXPECT_TRUE(std::ranges::any_of(sectors, [&](const PointsSector& sector) {
          return covers(sector, azimuth);
        })) << azimuth;
      }
    }
  }
}

// Of 22 datagrams, 17 degrees each, which reach 4 degrees further to both sides by the other laser.
TEST_P(TurnSectors, ALostDatagramsDirectionsAreUnwatched) {
  const std::vector<WirePoint> points = turn(30, GetParam(), all_around);
  std::vector<PointsSector> sectors = sectors_of_scan(points, kMost, kWhole);
  ASSERT_EQ(sectors.size(), 22U);
  constexpr std::size_t kLost = 5;
  const std::int64_t middle = points[kLost * kMost + kMost / 2].first;
  sectors.erase(sectors.begin() + kLost);
  const auto is_watched = [&](std::int64_t azimuth) {
    return std::ranges::any_of(sectors,
                               [&](const PointsSector& sector) { return covers(sector, azimuth); });
  };
  EXPECT_FALSE(is_watched(middle));
  EXPECT_TRUE(is_watched((middle + 20 * kDegree) % kTurn));
  EXPECT_TRUE(is_watched((middle - 20 * kDegree + kTurn) % kTurn));
}

// 270 degrees ahead, of which nothing comes back from the outermost 35 on both sides.
TEST_P(TurnSectors, OfLessThanATurnEndWithTheFieldOfView) {
  constexpr PointsSector kField{.begin = 225 * kDegree, .width = 270 * kDegree};
  std::vector<WirePoint> points =
      turn(180, GetParam(), [](std::int64_t degree) { return degree < 100 || degree >= 260; });
  const std::vector<PointsSector> sectors = sectors_of_scan(points, kMost, kField);
  ASSERT_EQ(sectors.size(), (points.size() + kMost - 1) / kMost);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(covers(sectors[i / kMost], points[i].first)) << i;
  }
  for (std::int64_t azimuth = 0; azimuth < kTurn; azimuth += kDegree / 4) {
    EXPECT_EQ(std::ranges::any_of(
                  sectors, [&](const PointsSector& sector) { return covers(sector, azimuth); }),
              covers(kField, azimuth))
        << azimuth;
  }
  const std::int64_t middle = points[3 * kMost + kMost / 2].first;
  EXPECT_EQ(std::ranges::count_if(
                sectors, [&](const PointsSector& sector) { return covers(sector, middle); }),
            1)
      << "where one that is lost leaves nothing";
}

INSTANTIATE_TEST_SUITE_P(EitherWay, TurnSectors, ::testing::Bool());

TEST(TurnSectorsOf, PointsInAnotherOrderAreNone) {
  std::vector<WirePoint> points = turn(0, true, all_around);
  std::rotate(points.begin(), points.begin() + 900, points.end());
  EXPECT_FALSE(sectors_of_scan(points, kMost, kWhole).empty());
  std::ranges::stable_sort(points, {}, [](const WirePoint& point) { return point.first % 7; });
  EXPECT_TRUE(sectors_of_scan(points, kMost, kWhole).empty());
  EXPECT_TRUE(sectors_of_scan({}, kMost, kWhole).empty());
}

}  // namespace
}  // namespace iog::tools
