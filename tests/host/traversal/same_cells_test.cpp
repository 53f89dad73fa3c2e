// Lines that are said to go through the same cells do; and lines that nearly coincide are mostly
// said to.
#include "traversal/same_cells.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "traversal/walk.hpp"

namespace iog::traversal {
namespace {

// The definition: term after term.
std::uint32_t first_by_looking(std::uint32_t threshold, std::uint32_t x, std::uint32_t up,
                               std::uint32_t circle, std::uint32_t limit) {
  for (std::uint32_t number = 0; number < limit; ++number) {
    if (x <= threshold) {
      return number;
    }
    x = (x + up) % circle;
  }
  return limit;
}

TEST(FirstNotAbove, IsTheFirstTermThatIsNot) {
  tests::Random random(5);
  for (int i = 0; i < tests::effort(200'000, 4'000); ++i) {
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random.below(n)); };
    const std::uint32_t circle = 2 + below(random.one_in(2) ? 40 : 700'000);
    const std::uint32_t up = below(circle + 1);
    const std::uint32_t x = below(circle);
    const std::uint32_t threshold = below(random.one_in(2) ? 5 : circle / 100 + 1);
    const std::uint32_t limit = below(700);
    ASSERT_EQ(first_not_above(threshold, x, circle - up, up, limit),
              first_by_looking(threshold, x, up, circle, limit))
        << threshold << " from " << x << " up " << up << " of " << circle << ", limit " << limit;
  }
}

constexpr std::int32_t kStride = 1 << 13;

template <std::int32_t kResolution>
std::vector<std::size_t> cells_of(const Line<kResolution>& line, std::uint32_t borders) {
  std::vector<std::size_t> cells;
  Walk walk(line, {}, kStride);
  walk.until(borders, [&](std::size_t offset) { cells.push_back(offset); });
  return cells;
}

// Two lines of nearly one direction, their ends at most `apart` subcells off it.
template <std::int32_t kResolution>
struct NearLines {
  NearLines(tests::Random& random, std::int32_t reach_cells, std::int32_t apart)
      : a({}, {}), b({}, {}) {
    const std::int32_t reach = reach_cells * kResolution;
    const SubcellPoint start{random.between(0, 4 * kResolution), random.between(0, kResolution)};
    const std::int32_t dx = random.one_in(9) ? 0 : random.between(-reach, reach);
    const std::int32_t dy = random.one_in(9) ? 0 : random.between(-reach, reach);
    const std::int64_t longer = random.between(1000, 1010);
    const auto other = [&](std::int32_t length) {
      return static_cast<std::int32_t>(length * longer / 1000) + random.between(-apart, apart);
    };
    a = Line<kResolution>(start, {start.x + dx, start.y + dy});
    b = Line<kResolution>(start, {start.x + other(dx), start.y + other(dy)});
  }

  Line<kResolution> a;
  Line<kResolution> b;
};

// How many of such pairs are said to share their first cells. All that are do.
template <std::int32_t kResolution>
int count_of_shared(std::int32_t reach_cells, std::int32_t apart, int count) {
  tests::Random random(static_cast<std::uint64_t>(kResolution + apart));
  int shared = 0;
  for (int i = 0; i < count; ++i) {
    const NearLines<kResolution> lines(random, reach_cells, apart);
    const std::uint32_t borders = lines.a.before({1, 1}).crossed() + 1;
    if (!may_meet_corner(lines.a) && same_cells(lines.a, lines.b, borders)) {
      ++shared;
      EXPECT_EQ(cells_of(lines.a, borders), cells_of(lines.b, borders));
    }
  }
  return shared;
}

TEST(SameCells, AreTheSame) {
  const int count = tests::effort(10'000, 200);
  EXPECT_GT(count_of_shared<20>(30, 1, count), count / 100);
  EXPECT_GT(count_of_shared<100>(30, 1, count), count / 4);
  EXPECT_GT(count_of_shared<1024>(100, 30, count), count / 4);
  EXPECT_GT(count_of_shared<1024>(500, 20, count), count / 100);
}

// Ends that are off by their rounding only, after 200 and 500 cells; one pair in five runs along an
// axis, where the other line often leans into another quadrant.
TEST(SameCells, AreFoundWhereOnlyTheRoundingDiffers) {
  const int count = tests::effort(4'000, 100);
  EXPECT_GT(count_of_shared<1024>(200, 1, count), count * 8 / 10);
  EXPECT_GT(count_of_shared<1024>(500, 1, count), count * 7 / 10);
}

// From a corner both lines cross it first, and only what comes then can part them.
TEST(SameCells, AreFoundFromACorner) {
  tests::Random random(17);
  const int count = tests::effort(4'000, 200);
  int shared = 0;
  for (int i = 0; i < count; ++i) {
    const SubcellPoint start{512 * 1024, 512 * 1024};
    const SubcellPoint end{start.x - random.between(1, 200 * 1024),
                           start.y - random.between(1, 200 * 1024)};
    const Line<1024> a(start, end);
    const Line<1024> b(start, {end.x + random.between(-1, 1), end.y + random.between(-1, 1)});
    const std::uint32_t borders = a.before({1, 1}).crossed() + 1;
    if (!may_meet_corner(a) && same_cells(a, b, borders)) {
      ++shared;
      ASSERT_EQ(cells_of(a, borders), cells_of(b, borders));
    }
  }
  EXPECT_GT(shared, count * 8 / 10);
}

TEST(SameCells, AreNotThoseOfAnotherQuadrantOrDirection) {
  const SubcellPoint start{512, 300};
  const Line<1024> line(start, {400'000, 90'000});
  EXPECT_TRUE(same_cells(line, line, 400));
  EXPECT_FALSE(same_cells(line, Line<1024>(start, {400'000, -90'000}), 400));
  EXPECT_FALSE(same_cells(line, Line<1024>(start, {400'000, 92'000}), 400));
}

}  // namespace
}  // namespace iog::traversal
