// The ruler reads what the line says, at distances on borders and between them.
#include "traversal/ruler.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::traversal {
namespace {

// The line's cells are at least 10 cm wide.
template <std::int32_t kResolution>
void expect_the_line_s_own_answer(std::uint32_t length_mm, int count) {
  tests::Random random(length_mm);
  const LineLength length(length_mm);
  const auto reach = static_cast<std::int32_t>(length_mm / 100) * kResolution;
  for (int i = 0; i < count; ++i) {
    const auto coordinate = [&] {
      const std::int32_t any = random.between(-reach, reach);
      return random.one_in(3) ? any / kResolution * kResolution : any;
    };
    const SubcellPoint start{coordinate() % 4096, coordinate() % 4096};
    const SubcellPoint end{random.one_in(6) ? start.x : start.x + coordinate(),
                           random.one_in(6) ? start.y : start.y + coordinate()};
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

// It would be no use if it mostly had to ask: one time in 2^12 for each axis, and on borders.
TEST(Ruler, SeldomHasToAsk) {
  const LineLength length(50'000);
  const Axis<1024> axis(300, 411'222);
  const AxisRuler<1024> ruler(axis, length);
  int asked = 0;
  for (std::uint32_t mm = 0; mm <= 50'000; ++mm) {
    const auto reading = ruler.through(mm);
    asked += reading.is_exact ? 0 : 1;
    ASSERT_LE(reading.crossed, axis.through(mm, length));
    ASSERT_GE(reading.crossed + 1, axis.through(mm, length));
  }
  EXPECT_LE(asked, 2 * 50'000 / 4096);
}

}  // namespace
}  // namespace iog::traversal
