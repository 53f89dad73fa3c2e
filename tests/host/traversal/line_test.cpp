// Where a line is after a share of its length, and which part of it lies in a grid.
#include "traversal/line.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "lab/reference/exact_line.hpp"
#include "traversal/walk.hpp"

namespace iog::traversal {
namespace {

using TestLine = Line<64>;
constexpr std::int32_t kR = 64;
constexpr std::uint32_t kLengthMm = 7'300;

struct RandomLine {
  SubcellPoint start;
  SubcellPoint end;
};

RandomLine random_line(tests::Random& random, std::int32_t reach) {
  const auto coordinate = [&] {
    const std::int32_t any = random.between(-reach, reach);
    return random.one_in(4) ? any / kR * kR : any;
  };
  RandomLine line{{coordinate(), coordinate()}, {coordinate(), coordinate()}};
  line.end.x = random.one_in(8) ? line.start.x : line.end.x;
  line.end.y = random.one_in(8) ? line.start.y : line.end.y;
  return line;
}

// The cell of the point at share n / d of the line: floor division, on a border the later cell.
std::int32_t cell_at(std::int32_t start, std::int32_t end, std::int64_t n, std::int64_t d) {
  const std::int64_t at = start * d + (std::int64_t{end} - start) * n;
  const std::int64_t side = kR * d;
  return static_cast<std::int32_t>(end < start ? -numeric::div_floor(-at, side) - 1
                                               : numeric::div_floor(at, side));
}

TEST(Line, ThroughNamesTheCellThatHoldsThePoint) {
  tests::Random random(3);
  const LineLength length(kLengthMm);
  for (int i = 0; i < tests::effort(200'000, 5'000); ++i) {
    const RandomLine ends = random_line(random, 20 * kR);
    const TestLine line(ends.start, ends.end);
    const auto mm = static_cast<std::uint32_t>(random.between(0, kLengthMm));
    const Cell cell = line.cell(line.through(mm, length));
    ASSERT_EQ(cell.x, cell_at(ends.start.x, ends.end.x, mm, kLengthMm));
    ASSERT_EQ(cell.y, cell_at(ends.start.y, ends.end.y, mm, kLengthMm));
    ASSERT_EQ(line.through(mm, length), line.through(Share{mm, kLengthMm}));
  }
}

// `before` is the last cell entered before the share, `through` the first not left by then.
TEST(Line, BeforeNamesTheLastCellWhoseInteriorWasEntered) {
  tests::Random random(4);
  for (int i = 0; i < tests::effort(100'000, 5'000); ++i) {
    const RandomLine ends = random_line(random, 20 * kR);
    const TestLine line(ends.start, ends.end);
    const lab::reference::Rational share{random.between(1, 40), 40};
    const Position at = line.before({static_cast<std::uint64_t>(share.numerator), 40});
    const auto crossing = lab::reference::cross(ends.start, ends.end, line.cell(at), kR);
    if (crossing) {
      ASSERT_TRUE(crossing->enter < share);
      ASSERT_TRUE(share <= crossing->leave);
    } else {
      ASSERT_EQ(at, Position{});  // the start cell of a line that only touches it
    }
  }
}

// Walking to a position and computing its error term lead to the same place.
TEST(Line, AWalkMayBeginAnywhere) {
  tests::Random random(5);
  constexpr std::int32_t kStride = 4096;
  for (int i = 0; i < tests::effort(20'000, 1'000); ++i) {
    const RandomLine ends = random_line(random, 20 * kR);
    const TestLine line(ends.start, ends.end);
    const Position half = line.through(Share{1, 2});
    const std::uint32_t end = line.before({1, 1}).crossed() + 1;
    std::vector<std::size_t> whole;
    std::vector<std::size_t> parts;
    Walk(line, {}, kStride).until(end, [&](std::size_t at) { whole.push_back(at); });
    Walk(line, {}, kStride).until(std::min(half.crossed(), end), [&](std::size_t at) {
      parts.push_back(at);
    });
    Walk(line, half, kStride).until(end, [&](std::size_t at) { parts.push_back(at); });
    ASSERT_EQ(whole, parts);
  }
}

// Inside, outside, through, past: what lies in the grid is what the endless walk visits there.
TEST(Line, ClippingKeepsExactlyTheCellsInside) {
  tests::Random random(6);
  constexpr CellArea kArea{7, 5};
  constexpr std::int32_t kStride = 4096;
  int outcomes[2] = {0, 0};
  for (int i = 0; i < tests::effort(200'000, 5'000); ++i) {
    const RandomLine ends = random_line(random, 14 * kR);
    const TestLine line(ends.start, ends.end);
    const std::uint32_t end = line.before({1, 1}).crossed() + 1;
    std::vector<std::size_t> expected;
    Walk(line, {}, kStride).until(end, [&](std::size_t offset) {
      const auto linear = static_cast<std::int32_t>(offset);
      const std::int32_t y = numeric::div_floor(linear + kStride / 2, kStride);
      if (kArea.contains({linear - y * kStride, y})) {
        expected.push_back(offset);
      }
    });
    const auto stretch = line.clip(kArea);
    std::vector<std::size_t> visited;
    if (stretch) {
      ASSERT_TRUE(kArea.contains(line.cell(stretch->first)));
      Walk(line, stretch->first, kStride)
          .until(std::min(end, stretch->last.crossed() + 1),
                 [&](std::size_t offset) { visited.push_back(offset); });
    }
    ASSERT_EQ(visited, expected) << "(" << ends.start.x << ", " << ends.start.y << ") to ("
                                 << ends.end.x << ", " << ends.end.y << ")";
    ++outcomes[expected.empty() ? 0 : 1];
  }
  EXPECT_GT(outcomes[0], 100);
  EXPECT_GT(outcomes[1], 100);
}

}  // namespace
}  // namespace iog::traversal
