// Which lines meet a corner between cells: none of them is taken for one that does not.
#include "traversal/corner.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "traversal/walk.hpp"

namespace iog::traversal {
namespace {

constexpr std::int32_t kReachCells = 64;

template <std::int32_t kResolution>
struct RandomLine {
  explicit RandomLine(tests::Random& random)
      : start{coordinate(random), coordinate(random)},
        end{random.one_in(8) ? start.x : coordinate(random),
            random.one_in(8) ? start.y : coordinate(random)} {}

  // Often on a border, half or a quarter of a cell away from it.
  static std::int32_t coordinate(tests::Random& random) {
    constexpr std::int32_t kReach = kReachCells * kResolution;
    const std::int32_t any = random.between(-kReach, kReach);
    const std::int32_t part = std::max<std::int32_t>(kResolution >> random.between(0, 2), 1);
    return random.one_in(2) ? any / part * part : any;
  }

  SubcellPoint start;
  SubcellPoint end;
};

// Without a corner each step of the walk crosses one border; a corner at the start is two borders
// in one step.
template <std::int32_t kResolution>
void expect_a_border_a_step(int count) {
  constexpr std::int32_t kStride = 4 * kReachCells;
  tests::Random random(kResolution + 1);
  int without = 0;
  for (int i = 0; i < count; ++i) {
    const RandomLine<kResolution> ends(random);
    const Line<kResolution> line(ends.start, ends.end);
    if (may_meet_corner(line)) {
      continue;
    }
    ++without;
    const std::uint32_t end = line.before({1, 1}).crossed() + 1;
    std::uint32_t cells = 0;
    Walk(line, {}, kStride).until(end, [&](std::size_t) { ++cells; });
    ASSERT_EQ(cells + (starts_on_corner(line) ? 1U : 0U), end)
        << "r " << kResolution << ", (" << ends.start.x << ", " << ends.start.y << ") to ("
        << ends.end.x << ", " << ends.end.y << ")";
  }
  EXPECT_GT(without, count / 4);
}

TEST(Corner, IsMissingWhereEveryStepCrossesOneBorder) {
  const int count = tests::effort(20'000, 300);
  expect_a_border_a_step<20>(count);
  expect_a_border_a_step<100>(count);
  expect_a_border_a_step<200>(count);
  expect_a_border_a_step<1024>(count);
}

// Whether the line crosses a corner after its start, found column by column.
template <std::int32_t kResolution>
bool crosses_corner(const RandomLine<kResolution>& ends) {
  const std::int64_t dx = ends.end.x - ends.start.x;
  const std::int64_t dy = ends.end.y - ends.start.y;
  if (dx == 0 || dy == 0) {
    return false;
  }
  for (std::int64_t x = -kReachCells; x <= kReachCells; ++x) {
    const std::int64_t to_x = x * kResolution - ends.start.x;
    const bool is_on_line = dx < 0 ? dx <= to_x && to_x <= 0 : 0 <= to_x && to_x <= dx;
    const bool is_corner =
        to_x * dy % dx == 0 && (ends.start.y + to_x * dy / dx) % kResolution == 0;
    if (is_on_line && is_corner && to_x != 0) {
      return true;
    }
  }
  return false;
}

// No corner is missed.
template <std::int32_t kResolution>
void expect_no_corner_is_missed(int count) {
  tests::Random random(kResolution + 2);
  int corners = 0;
  for (int i = 0; i < count; ++i) {
    const RandomLine<kResolution> ends(random);
    if (crosses_corner(ends)) {
      ++corners;
      ASSERT_TRUE(may_meet_corner(Line<kResolution>(ends.start, ends.end)));
    }
  }
  EXPECT_GT(corners, count / 200);
}

TEST(Corner, IsForeseen) {
  const int count = tests::effort(60'000, 1'000);
  expect_no_corner_is_missed<1>(count);
  expect_no_corner_is_missed<20>(count);
  expect_no_corner_is_missed<100>(count);
  expect_no_corner_is_missed<1024>(count);
  EXPECT_TRUE(may_meet_corner(Line<10>({5, 5}, {35, 35})));
  EXPECT_TRUE(may_meet_corner(Line<10>({20, 20}, {5, 5})));
  EXPECT_TRUE(may_meet_corner(Line<10>({5, 5}, {75, 35})));
}

// A corner is left towards the cell below and to the left, and nowhere else is it crossed.
TEST(Corner, IsCrossedByTheFirstStepTowardsMinusOnBothAxes) {
  EXPECT_TRUE(starts_on_corner(Line<10>({20, 20}, {7, 2})));
  EXPECT_FALSE(starts_on_corner(Line<10>({20, 20}, {27, 2})));
  EXPECT_FALSE(starts_on_corner(Line<10>({20, 20}, {7, 32})));
  EXPECT_FALSE(starts_on_corner(Line<10>({20, 20}, {33, 32})));
  EXPECT_FALSE(starts_on_corner(Line<10>({20, 20}, {20, 2})));
  EXPECT_FALSE(starts_on_corner(Line<10>({20, 21}, {7, 2})));
}

// Along an axis a line stays in its row, which it does not leave through a corner.
TEST(Corner, IsNotMetAlongAnAxis) {
  EXPECT_FALSE(may_meet_corner(Line<10>({20, 20}, {90, 20})));
  EXPECT_FALSE(may_meet_corner(Line<10>({20, 20}, {20, -90})));
  EXPECT_FALSE(may_meet_corner(Line<10>({25, 25}, {-95, 25})));
}

// From an odd place every corner needs a common divisor with a resolution of many.
TEST(Corner, IsRare) {
  int corners = 0;
  for (std::int32_t y = -40'000; y <= 40'000; y += 100) {
    corners += may_meet_corner(Line<1024>({19'968, 6'144}, {500'017, y})) ? 1 : 0;
    corners += may_meet_corner(Line<1024>({19'973, 6'147}, {500'017, y})) ? 1 : 0;
  }
  EXPECT_LT(corners, 1602 / 100);
}

}  // namespace
}  // namespace iog::traversal
