// The surface of a road against the distance from its middle.
#include "tools/map/road_outline.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

double distance(const PlanePoint& point, const PlanePoint& from, const PlanePoint& to) {
  const double x = to.x - from.x;
  const double y = to.y - from.y;
  const double along = ((point.x - from.x) * x + (point.y - from.y) * y) / (x * x + y * y);
  const double share = std::clamp(along, 0.0, 1.0);
  return std::hypot(point.x - from.x - share * x, point.y - from.y - share * y);
}

double distance(const PlanePoint& point, const std::vector<PlanePoint>& line) {
  double least = 1e9;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    least = std::min(least, distance(point, line[i], line[i + 1]));
  }
  return least;
}

bool is_inside(const PlanePoint& point, const Ring& ring) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PlanePoint& from = ring[i];
    const PlanePoint& to = ring[(i + 1) % ring.size()];
    if ((from.y <= point.y) != (to.y <= point.y) &&
        point.x < from.x + (point.y - from.y) / (to.y - from.y) * (to.x - from.x)) {
      inside = !inside;
    }
  }
  return inside;
}

bool is_on(const PlanePoint& point, const std::vector<Ring>& rings) {
  return std::ranges::any_of(rings, [&](const Ring& ring) { return is_inside(point, ring); });
}

// Bends of all kinds: gentle, sharp, back on themselves, with and without room to turn.
std::vector<PlanePoint> wild_line(std::mt19937& random) {
  std::vector<PlanePoint> line{{0, 0}};
  double heading = 0;
  const double bend = random() % 3 == 0 ? 3 : 0.4;
  for (int i = 0; i < 12; ++i) {
    heading += (static_cast<double>(random() % 2'001) - 1'000) / 1'000 * bend;
    const double length = random() % 4 == 0 ? 40 : 200 + static_cast<double>(random() % 4'000);
    line.push_back(
        {line.back().x + length * std::cos(heading), line.back().y + length * std::sin(heading)});
  }
  return line;
}

// All that is within 0.92 of half the width of the middle is road (a half circle is cut by 8 %),
// nothing beyond 1.16 of it is (the outer corner of a turn by 60 degrees: 1 / cos 30).
TEST(RoadOutline, IsWithinHalfTheWidthOfTheMiddle) {
  std::mt19937 random(11);
  for (int i = 0; i < 60; ++i) {
    const auto line = wild_line(random);
    const double width = 300 + static_cast<double>(random() % 900);
    const auto rings = outlines_of({line, width, true, true});
    for (int k = 0; k < 4'000; ++k) {
      const PlanePoint& near = line[random() % line.size()];
      const PlanePoint point{near.x + static_cast<double>(random() % 4'000) - 2'000,
                             near.y + static_cast<double>(random() % 4'000) - 2'000};
      const double off = distance(point, line) / (width / 2);
      if (off < 0.92) {
        ASSERT_TRUE(is_on(point, rings)) << i << ": " << point.x << ", " << point.y;
      } else if (off > 1.16) {
        ASSERT_FALSE(is_on(point, rings)) << i << ": " << point.x << ", " << point.y;
      }
    }
  }
}

TEST(RoadOutline, EndsFlatWhereNothingFollows) {
  const auto rings = outlines_of({{{0, 0}, {1'000, 0}}, 600, false, true});
  EXPECT_TRUE(is_on({1, 299}, rings));
  EXPECT_FALSE(is_on({-1, 0}, rings));
  EXPECT_TRUE(is_on({1'250, 0}, rings));
  EXPECT_FALSE(is_on({1'301, 0}, rings));
}

// So that a piece stands in few buckets.
TEST(RoadOutline, HasNoLongPieces) {
  const auto rings = outlines_of({{{0, 0}, {100'000, 50'000}}, 600, false, false});
  EXPECT_GE(rings.size(), 8U);
  for (const Ring& ring : rings) {
    for (const PlanePoint& point : ring) {
      EXPECT_LE(std::hypot(point.x - ring[0].x, point.y - ring[0].y), kMaxPieceCm + 601);
    }
  }
  for (int step = 1; step < 500; ++step) {
    EXPECT_TRUE(is_on({200.0 * step, 100.0 * step}, rings)) << step;
  }
}

TEST(RoadOutline, OfNoLengthIsNothing) {
  EXPECT_TRUE(outlines_of({{}, 600, true, true}).empty());
  EXPECT_TRUE(outlines_of({{{5, 5}}, 600, true, true}).empty());
  EXPECT_TRUE(outlines_of({{{5, 5}, {5.5, 5}, {5, 5}}, 600, true, true}).empty());
}

}  // namespace
}  // namespace iog::tools
