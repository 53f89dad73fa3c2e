// A driver may publish several clouds for a turn of its unit.
#include "tools/clouds/turn_parts.hpp"

#include <cmath>
#include <random>

#include "gtest/gtest.h"

#include "lidar/points.hpp"

namespace iog::tools {
namespace {

constexpr int kTaken = 40;

// Of clouds that turn on by so many degrees from one to the next, and see so many, but for those
// from which nothing comes back.
std::uint64_t parts_of(int step_deg, int width_deg, int first_open_deg = 360) {
  TurnParts parts;
  for (int cloud = 0; cloud < kTaken; ++cloud) {
    std::vector<WirePoint> points;
    for (int i = 0; i < width_deg; ++i) {
      const int degree = (cloud * step_deg + i) % 360;
      if (degree < first_open_deg) {
        points.push_back({.first = degree * lidar::PointsPacket::kPartsPerDegree});
      }
    }
    parts.take(points);
  }
  return parts.parts();
}

TEST(TurnParts, OfHalfATurnAndLessAreTold) {
  for (const int degrees : {180, 150, 120, 90, 36}) {
    EXPECT_EQ(parts_of(degrees, degrees), kTaken - 1U) << degrees;
    EXPECT_EQ(parts_of(degrees, degrees + 5), kTaken - 1U) << degrees;
  }
}

// 32 points of a sector, as a driver publishes it that does not wait for the turn.
TEST(TurnParts, NarrowSectorsAreTold) {
  for (const int sectors : {16, 20, 32, 64}) {
    TurnParts parts;
    for (int cloud = 0; cloud < kTaken; ++cloud) {
      std::vector<WirePoint> points;
      for (int i = 0; i < 32; ++i) {
        const double turns = (cloud + i / 32.0) / sectors;
        points.push_back({.first = static_cast<std::int32_t>((turns - std::floor(turns)) *
                                                             lidar::PointsPacket::kPartsPerTurn)});
      }
      parts.take(points);
    }
    EXPECT_EQ(parts.parts(), kTaken - 1U) << sectors;
  }
}

TEST(TurnParts, WholeTurnsAndOneFieldOfViewAreNone) {
  for (const int step_deg : {0, 7, 180, 355}) {
    for (const int first_open_deg : {360, 200, 60, 20, 1, 0}) {
      EXPECT_EQ(parts_of(step_deg, 360, first_open_deg), 0U) << step_deg << ' ' << first_open_deg;
    }
  }
  EXPECT_EQ(parts_of(0, 120), 0U);
}

// Of a field, or in rain.
TEST(TurnParts, WholeTurnsWithFewReturnsAreNone) {
  for (const int returns : {8, 12, 16, 30, 60}) {
    std::mt19937 random(1);
    TurnParts parts;
    for (int cloud = 0; cloud < kTaken; ++cloud) {
      std::vector<WirePoint> points;
      for (int i = 0; i < returns; ++i) {
        const auto degree = static_cast<int>(random() % 360);
        points.push_back({.first = degree * lidar::PointsPacket::kPartsPerDegree});
      }
      parts.take(points);
    }
    EXPECT_EQ(parts.parts(), 0U) << returns;
  }
}

}  // namespace
}  // namespace iog::tools
