// Boxes and ranges beside floating point.
#include "objects/plane.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::objects {
namespace {

using iog::tests::effort;
using iog::tests::Random;

Box random_box(Random& random) {
  const double angle = random.between(0, 6283) * 1e-3;
  Box box{.at = {random.between(-900'000'000, 900'000'000), random.between(-9'000, 9'000)},
          .along = {static_cast<std::int32_t>(std::round(16'384 * std::cos(angle))),
                    static_cast<std::int32_t>(std::round(16'384 * std::sin(angle)))}};
  for (Interval& side : box.sides) {
    side = {random.between(-8'000, 0), random.between(1, 8'000)};
  }
  return box;
}
Point near(const Box& box, Random& random) {
  return {box.at.x_mm + random.between(-30'000, 30'000),
          box.at.y_mm + random.between(-30'000, 30'000)};
}

TEST(Box, PlacesArePointsTurnedBack) {
  Random random(1);
  for (int i = 0; i < effort(20'000, 500); ++i) {
    const Box box = random_box(random);
    const Point point = near(box, random);
    const double dx = point.x_mm - box.at.x_mm;
    const double dy = point.y_mm - box.at.y_mm;
    const double c = box.along.x / 16'384.0;
    const double s = box.along.y / 16'384.0;
    ASSERT_EQ(box.place(point, kAlong), std::floor(dx * c + dy * s));
    ASSERT_EQ(box.place(point, kAcross), std::floor(dy * c - dx * s));
  }
}

TEST(Box, ItsCornersAreItsSides) {
  Random random(2);
  for (int i = 0; i < effort(5'000, 200); ++i) {
    const Box box = random_box(random);
    for (unsigned number = 0; number < 4; ++number) {
      const Point corner = box.corner(number);
      const Interval& along = box.sides[kAlong];
      const Interval& across = box.sides[kAcross];
      ASSERT_NEAR(box.place(corner, kAlong), (number & 1U) != 0 ? along.high : along.low, 3);
      ASSERT_NEAR(box.place(corner, kAcross), (number & 2U) != 0 ? across.high : across.low, 3);
      ASSERT_LE(box.outside(corner), 3);
    }
  }
}

// The way is sampled in steps of 60 mm at most; where the box is only grazed it may say either.
TEST(Box, IsBetweenTwoPointsIfTheWayMeetsIt) {
  Random random(3);
  int met = 0;
  for (int i = 0; i < effort(3'000, 100); ++i) {
    const Box box = random_box(random);
    const Point from = near(box, random);
    const Point to = near(box, random);
    std::int32_t deepest = INT32_MIN;  // how far inside of the box the way gets
    for (int step = 0; step <= 1'500; ++step) {
      const auto share = [&](std::int32_t a, std::int32_t b) {
        return a + static_cast<std::int32_t>((std::int64_t{b} - a) * step / 1'500);
      };
      const Point point{share(from.x_mm, to.x_mm), share(from.y_mm, to.y_mm)};
      std::int32_t inside = INT32_MAX;
      for (const Side side : kSides) {
        const std::int32_t its = box.place(point, side);
        inside = std::min({inside, its - box.sides[side].low, box.sides[side].high - its});
      }
      deepest = std::max(deepest, inside);
    }
    if (deepest > 70 || deepest < -70) {
      ASSERT_EQ(box.is_between(from, to), deepest > 0) << i;
      met += deepest > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(met, 10);
}

// As far from one corner as from the other, but for the half of an odd length.
TEST(Bounds, TheirMiddleIsAsFarFromEachCorner) {
  Random random(5);
  for (int i = 0; i < effort(5'000, 200); ++i) {
    Bounds bounds;
    for (int point = 0; point < 3; ++point) {
      bounds.include({random.between(-900'000'000, 900'000'000), random.between(-9'000, 9'000)});
    }
    const Point middle = bounds.middle();
    for (const std::int32_t off :
         {(bounds.high.x_mm - middle.x_mm) - (middle.x_mm - bounds.low.x_mm),
          (bounds.high.y_mm - middle.y_mm) - (middle.y_mm - bounds.low.y_mm)}) {
      ASSERT_GE(off, 0);
      ASSERT_LE(off, 1);
    }
  }
}

TEST(Plane, ARangeIsItsRootToASixteenth) {
  Random random(4);
  for (int i = 0; i < effort(20'000, 500); ++i) {
    const Point from{random.between(-50'000, 50'000), random.between(-50'000, 50'000)};
    const Point to{random.between(-50'000, 50'000), random.between(-50'000, 50'000)};
    const double root = std::hypot(to.x_mm - from.x_mm, to.y_mm - from.y_mm);
    ASSERT_NEAR(range_mm(from, to), root, root / 14 + 2);
  }
}

}  // namespace
}  // namespace iog::objects
