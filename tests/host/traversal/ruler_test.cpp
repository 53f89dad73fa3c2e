// The ruler reads what the line says, at distances on borders and between them.
#include "traversal/ruler.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::traversal {
namespace {

struct Ends {
  SubcellPoint start;
  SubcellPoint end;
};

// Of a line whose cells are at least 10 cm wide, often on their borders or along an axis.
template <std::int32_t kResolution>
Ends random_ends(tests::Random& random, std::uint32_t length_mm) {
  const auto reach = static_cast<std::int32_t>(length_mm / 100) * kResolution;
  const auto coordinate = [&] {
    const std::int32_t any = random.between(-reach, reach);
    return random.one_in(3) ? any / kResolution * kResolution : any;
  };
  const SubcellPoint start{coordinate() % 4096, coordinate() % 4096};
  const SubcellPoint end{random.one_in(6) ? start.x : start.x + coordinate(),
                         random.one_in(6) ? start.y : start.y + coordinate()};
  return {start, end};
}

template <std::int32_t kResolution>
void expect_the_line_s_own_answer(std::uint32_t length_mm, int count) {
  tests::Random random(length_mm);
  const LineLength length(length_mm);
  for (int i = 0; i < count; ++i) {
    const auto [start, end] = random_ends<kResolution>(random, length_mm);
    const Line<kResolution> line(start, end);
    const Ruler<kResolution> ruler(line, length);
    for (int j = 0; j < 20; ++j) {
      const auto any =
          static_cast<std::uint32_t>(random.between(0, static_cast<int>(length_mm) + 1'000));
      const std::uint32_t mm = random.one_in(2) ? any / 100 * 100 : any;
      ASSERT_EQ(ruler.through(mm, line, length), line.through(mm, length))
          << "(" << start.x << ", " << start.y << ") to (" << end.x << ", " << end.y << "), " << mm
          << " of " << length_mm << " mm";
    }
  }
}

TEST(Ruler, ReadsWhatTheLineSays) {
  const int count = tests::effort(10'000, 150);
  expect_the_line_s_own_answer<1>(50'000, count);
  expect_the_line_s_own_answer<20>(50'000, count);
  expect_the_line_s_own_answer<100>(50'000, count);
  expect_the_line_s_own_answer<1024>(50'000, count);
  expect_the_line_s_own_answer<1024>(130'000, count);
  expect_the_line_s_own_answer<1024>(65'536, count);
  expect_the_line_s_own_answer<1024>(300, count);
}

// Shares of the height to a band's end, in subcells: up to one of 26 m, often a whole number of
// cells along the line.
template <std::int32_t kResolution>
void expect_the_line_s_own_shares(std::uint32_t length_mm, int count) {
  tests::Random random(length_mm + 1);
  const LineLength length(length_mm);
  for (int i = 0; i < count; ++i) {
    const auto [start, end] = random_ends<kResolution>(random, length_mm);
    const Line<kResolution> line(start, end);
    const Ruler<kResolution> ruler(line, length);
    for (int j = 0; j < 20; ++j) {
      const bool is_round = random.one_in(2);
      const int denominator = is_round ? 1 << random.between(0, 10) : random.between(1, 1 << 18);
      const int numerator = random.one_in(8) ? denominator : random.between(0, denominator);
      const Share share{static_cast<std::uint64_t>(numerator),
                        static_cast<std::uint64_t>(denominator)};
      const numeric::Divisor divisor(static_cast<std::uint32_t>(denominator));
      const MeasuredShare measured(share, divisor, length);
      ASSERT_EQ(ruler.through(measured, line), line.through(share))
          << numerator << " / " << denominator << " of " << length_mm << " mm";
      ASSERT_EQ(ruler.before(measured, line), line.before(share))
          << numerator << " / " << denominator << " of " << length_mm << " mm";
    }
  }
}

TEST(Ruler, ReadsSharesAsTheLineDoes) {
  const int count = tests::effort(10'000, 150);
  expect_the_line_s_own_shares<1>(50'000, count);
  expect_the_line_s_own_shares<20>(50'000, count);
  expect_the_line_s_own_shares<1024>(50'000, count);
  expect_the_line_s_own_shares<1024>(130'000, count);
  expect_the_line_s_own_shares<1024>(300, count);
}

// It would be no use if it mostly had to ask: one time in 2^12 for each axis, and on borders.
TEST(Ruler, SeldomHasToAsk) {
  const LineLength length(50'000);
  const Axis<1024> axis(300, 411'222);
  const AxisRuler<1024> ruler(axis, length);
  int asked = 0;
  for (std::uint32_t mm = 0; mm <= 50'000; ++mm) {
    const std::uint64_t estimate = ruler.estimate(mm);
    asked += AxisRuler<1024>::is_exact(estimate) ? 0 : 1;
    ASSERT_LE(estimate >> 32, axis.through(mm, length));
    ASSERT_GE((estimate >> 32) + 1, axis.through(mm, length));
  }
  EXPECT_LE(asked, 2 * 50'000 / 4096);
}

}  // namespace
}  // namespace iog::traversal
