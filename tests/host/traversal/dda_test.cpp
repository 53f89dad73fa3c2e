// A line rises where it crosses a border of v: found by the carries of 32 bits, and here exactly,
// from the line's ends alone. Products of two lengths are below 2^43.
#include "traversal/dda.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "traversal/corner.hpp"

namespace iog::traversal {
namespace {

std::int64_t floor_of(std::int64_t dividend, std::int64_t divisor) {
  const std::int64_t quotient = dividend / divisor;
  return dividend % divisor < 0 ? quotient - 1 : quotient;
}

// The row in which the line is when it passes u = column r, from the row of its start. A start on
// the upper left corner of its cell is in its row; from the upper right corner the line rises at
// once.
template <std::int32_t kResolution>
std::int64_t row_at(const Axis<kResolution>& u, const Axis<kResolution>& v, std::int64_t column) {
  const std::int64_t along = std::int64_t{column} * kResolution - u.offset();
  const std::int64_t rise = std::int64_t{v.offset()} * u.length() + along * v.length();
  const bool is_upper_border = column == 0 && along == 0 && v.offset() == kResolution;
  return floor_of(is_upper_border ? rise - 1 : rise, std::int64_t{u.length()} * kResolution);
}

template <std::int32_t kResolution>
Line<kResolution> random_line(tests::Random& random, std::int32_t longest) {
  const SubcellPoint start{random.between(0, 4 * kResolution), random.between(0, 4 * kResolution)};
  const std::int32_t u = random.one_in(3) ? longest : random.between(1, longest);
  const std::int32_t near = random.between(0, random.one_in(2) ? 3 : 3 * kResolution);
  std::int32_t v = random.between(0, u);
  if (random.one_in(3)) {
    v = random.one_in(2) ? std::min<std::int32_t>(near, u) : std::max<std::int32_t>(u - near, 0);
  }
  const std::int32_t x = random.one_in(2) ? u : -u;
  const std::int32_t y = random.one_in(2) ? v : -v;
  return random.one_in(2) ? Line<kResolution>(start, {start.x + x, start.y + y})
                          : Line<kResolution>(start, {start.x + y, start.y + x});
}

// All columns of lines up to `longest`, which is most_columns' limit if it is the longest there is.
template <std::int32_t kResolution>
void expect_exact_rows(std::uint64_t seed, std::int32_t longest, int count) {
  SCOPED_TRACE(testing::Message() << "r " << kResolution << ", seed " << seed);
  tests::Random random(seed);
  int followed = 0;
  for (int i = 0; i < count; ++i) {
    const Line<kResolution> line = random_line<kResolution>(random, longest);
    if (may_meet_corner(line)) {
      continue;
    }
    const bool is_steep = line.y().length() > line.x().length();
    const Axis<kResolution>& u = is_steep ? line.y() : line.x();
    const Axis<kResolution>& v = is_steep ? line.x() : line.y();
    const auto before = static_cast<std::uint32_t>(random.between(0, 3));
    Dda dda = dda_of(line, is_steep, before);
    std::int64_t row = dda.row;
    const auto columns = static_cast<std::int64_t>(u.before_end() + 9 + before);
    ASSERT_LE(columns, most_columns(u.length()));
    for (std::int64_t column = -std::int64_t{before}; column < columns - before; ++column) {
      ASSERT_EQ(row, row_at(u, v, column)) << "line " << i << ", column " << column;
      row += dda.advance(0);
    }
    ++followed;
  }
  EXPECT_GT(followed, count / 40);  // at r = 1 most lines meet corners
}

TEST(Dda, IsInTheRowsOfTheLine) {
  const int count = tests::effort(4'000, 60);
  expect_exact_rows<1024>(1, 40 * 1024, count);
  expect_exact_rows<1024>(2, 512 * 1024, count);
  expect_exact_rows<1024>(3, 1'482'910, count);  // 2^31 / (sqrt(2) r): car_block/limits.cpp
  expect_exact_rows<200>(4, 2'600 * 200, count);
  expect_exact_rows<20>(5, 2'600 * 20, count);
  expect_exact_rows<1>(6, 2'600, count);
}

// A carry goes to the lowest bit, above what was there.
TEST(Dda, ShiftsItsRisesIntoBits) {
  Dda dda{.row = 0, .phase = 0, .step = 3U << 30};
  EXPECT_EQ(dda.advance(5), 10U);  // 3/4
  EXPECT_EQ(dda.advance(5), 11U);  // 6/4
  EXPECT_EQ(dda.phase, 1U << 31);
}

}  // namespace
}  // namespace iog::traversal
