// The continuous traversals against one another, against rational geometry
// (lab/reference/exact_line.hpp) and against the integer walk of the product; Bresenham's line
// against what he promised of it.
#include "lab/reference/traversal.hpp"

#include <gtest/gtest.h>
#include <string>

#include "fakes/random.hpp"
#include "lab/reference/exact_line.hpp"
#include "traversal/walk.hpp"

namespace iog::lab::reference {
namespace {

using Cells = std::vector<Cell>;
using geometry::SubcellPoint;

// Subcells per cell. A power of two, so that a coordinate in cells has no rounding error; ends on
// borders and lines through corners are then as frequent as they are exact.
constexpr std::int32_t kCoarse = 4;
constexpr std::int32_t kFine = 1024;

struct Segment {
  SubcellPoint start;
  SubcellPoint end;
};

Segment random_segment(tests::Random& random, std::int32_t r, std::int32_t cells) {
  const auto point = [&] {
    return SubcellPoint{random.between(-cells * r, cells * r),
                        random.between(-cells * r, cells * r)};
  };
  return {point(), point()};
}

CellPoint<double> in_cells(SubcellPoint point, std::int32_t r) {
  return {static_cast<double>(point.x) / r, static_cast<double>(point.y) / r};
}

bool contains(const Cells& cells, Cell cell) {
  return std::ranges::find(cells, cell) != cells.end();
}

// The start's cell, then those whose interior the segment crosses, in the order of its crossing.
Cells crossed_cells(const Segment& segment, std::int32_t r) {
  struct Entry {
    Rational at;
    Cell cell;
  };
  const auto cell_of = [r](SubcellPoint point) {
    return Cell{numeric::div_floor(point.x, r), numeric::div_floor(point.y, r)};
  };
  const Cell from = cell_of(segment.start);
  const Cell to = cell_of(segment.end);
  std::vector<Entry> entries;
  for (std::int32_t y = std::min(from.y, to.y); y <= std::max(from.y, to.y); ++y) {
    for (std::int32_t x = std::min(from.x, to.x); x <= std::max(from.x, to.x); ++x) {
      const Cell cell{x, y};
      if (cell != from && segment_crosses(segment.start, segment.end, cell, r)) {
        entries.push_back({cross(segment.start, segment.end, cell, r)->enter, cell});
      }
    }
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) { return a.at < b.at; });
  Cells cells{from};
  for (const Entry& entry : entries) {
    cells.push_back(entry.cell);
  }
  return cells;
}

std::string words(const Cells& cells) {
  std::string text;
  for (const Cell cell : cells) {
    text += '(';
    text += std::to_string(cell.x);
    text += ' ';
    text += std::to_string(cell.y);
    text += ')';
  }
  return text;
}

TEST(Continuous, CrossesWhatRationalGeometrySays) {
  tests::Random random(1);
  for (int round = 0; round < 4000; ++round) {
    const std::int32_t r = random.one_in(2) ? kCoarse : kFine;
    const Segment segment = random_segment(random, r, 12);
    const Cells cells = cells_continuous(in_cells(segment.start, r), in_cells(segment.end, r));
    ASSERT_EQ(words(cells), words(crossed_cells(segment, r))) << "r " << r;
  }
}

// Quotients are rounded, so that a corner may be passed on either side, but nothing else differs.
TEST(AmanatidesWoo, CrossesTheSameExceptAtCorners) {
  tests::Random random(2);
  for (int round = 0; round < 4000; ++round) {
    const std::int32_t r = random.one_in(2) ? kCoarse : kFine;
    const Segment segment = random_segment(random, r, 12);
    const Cells crossed = crossed_cells(segment, r);
    const Cells cells = cells_amanatides_woo(in_cells(segment.start, r), in_cells(segment.end, r));
    for (const Cell cell : crossed) {
      ASSERT_TRUE(contains(cells, cell)) << words(cells) << " against " << words(crossed);
    }
    for (const Cell cell : cells) {
      // Touched in a corner: no part of the line is inside, but the diagonal neighbours are
      // crossed.
      const bool is_passed_at_a_corner =
          (contains(crossed, {cell.x - 1, cell.y}) || contains(crossed, {cell.x + 1, cell.y})) &&
          (contains(crossed, {cell.x, cell.y - 1}) || contains(crossed, {cell.x, cell.y + 1}));
      ASSERT_TRUE(contains(crossed, cell) || is_passed_at_a_corner)
          << words(cells) << " against " << words(crossed);
    }
  }
}

TEST(AmanatidesWoo, EqualsTheErrorTermOnRealNumbers) {
  tests::Random random(3);
  const auto coordinate = [&] { return random.between(-1'000'000, 1'000'000) * 0.000'314'159; };
  for (int round = 0; round < 1000; ++round) {
    const CellPoint<double> start{coordinate(), coordinate()};
    const CellPoint<double> end{coordinate(), coordinate()};
    ASSERT_EQ(words(cells_amanatides_woo(start, end)), words(cells_continuous(start, end)));
  }
}

TEST(Continuous, EqualsTheIntegerWalkOnSubcells) {
  constexpr std::int32_t kStride = 1 << 14;
  tests::Random random(4);
  for (int round = 0; round < 4000; ++round) {
    const Segment segment = random_segment(random, kFine, 300);
    const traversal::Line<kFine> line(segment.start, segment.end);
    std::vector<std::size_t> offsets;
    traversal::Walk walk(line, {}, kStride);
    walk.until(line.before({1, 1}).crossed() + 1,
               [&](std::size_t offset) { offsets.push_back(offset); });
    std::vector<std::size_t> ours;
    walk_continuous(in_cells(segment.start, kFine), in_cells(segment.end, kFine), [&](Cell cell) {
      ours.push_back(static_cast<std::size_t>(cell.y * kStride + cell.x));
    });
    ASSERT_EQ(ours, offsets);
  }
}

// A mirror image has the mirrored cells. Ends are kept off the borders, where a mirror moves the
// point to another cell: they have a fraction of odd 64ths.
TEST(Continuous, IsSymmetric) {
  tests::Random random(5);
  const auto coordinate = [&] { return (2 * random.between(-1000, 1000) + 1) / 64.0; };
  for (int round = 0; round < 1000; ++round) {
    const CellPoint<double> start{coordinate(), coordinate()};
    const CellPoint<double> end{coordinate(), coordinate()};
    const Cells cells = cells_continuous(start, end);
    Cells mirrored = cells_continuous({-start.x, start.y}, {-end.x, end.y});
    Cells transposed = cells_continuous({start.y, start.x}, {end.y, end.x});
    Cells reversed = cells_continuous(end, start);
    for (Cell& cell : mirrored) {
      cell.x = -1 - cell.x;
    }
    for (Cell& cell : transposed) {
      std::swap(cell.x, cell.y);
    }
    std::ranges::reverse(reversed);
    ASSERT_EQ(words(mirrored), words(cells));
    ASSERT_EQ(words(transposed), words(cells));
    ASSERT_EQ(words(reversed), words(cells));
  }
}

TEST(Continuous, TakesDegenerateLines) {
  for (const auto walk : {cells_continuous, cells_amanatides_woo}) {
    EXPECT_EQ(words(walk({0.5, 0.5}, {0.5, 0.5})), "(0 0)");
    EXPECT_EQ(words(walk({2, 3}, {2, 3})), "(2 3)");
    // Along a border: the cells above it. On to a border: not across it.
    EXPECT_EQ(words(walk({0, 0}, {3, 0})), "(0 0)(1 0)(2 0)");
    EXPECT_EQ(words(walk({0, 0}, {0, 2})), "(0 0)(0 1)");
    EXPECT_EQ(words(walk({0, 0}, {2, 2})), "(0 0)(1 1)");
    // Against the direction of the cells' own borders: the start's cell, left at once.
    EXPECT_EQ(words(walk({2, 0.5}, {0, 0.5})), "(2 0)(1 0)(0 0)");
    EXPECT_EQ(words(walk({2, 2}, {0, 0})), "(2 2)(1 1)(0 0)");
  }
}

// "the nearest to the line", one for each step of the longer axis, ends included.
TEST(Bresenham, StaysWithinHalfACellOfTheLine) {
  tests::Random random(6);
  for (int round = 0; round < 4000; ++round) {
    const auto coordinate = [&] { return random.between(-60, 60); };
    const Cell from{coordinate(), coordinate()};
    const Cell to{coordinate(), coordinate()};
    const Cells cells = cells_bresenham(from, to);
    const std::int32_t width = std::abs(to.x - from.x);
    const std::int32_t height = std::abs(to.y - from.y);
    ASSERT_EQ(cells.front(), from);
    ASSERT_EQ(cells.back(), to);
    ASSERT_EQ(cells.size(), static_cast<std::size_t>(std::max(width, height)) + 1);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool is_flat = width >= height;
      const auto along = is_flat ? cells[i].x - from.x : cells[i].y - from.y;
      ASSERT_EQ(std::abs(along), static_cast<std::int32_t>(i));
      // Twice the distance beside the line, times the longer extent: at most that extent.
      const std::int32_t cross =
          (cells[i].y - from.y) * (to.x - from.x) - (cells[i].x - from.x) * (to.y - from.y);
      ASSERT_LE(2 * std::abs(cross), std::max(width, height));
    }
  }
}

TEST(Bresenham, IsSymmetric) {
  tests::Random random(7);
  for (int round = 0; round < 1000; ++round) {
    const Cell to{random.between(-60, 60), random.between(-60, 60)};
    const Cells cells = cells_bresenham({0, 0}, to);
    Cells mirrored = cells_bresenham({0, 0}, {-to.x, to.y});
    Cells transposed = cells_bresenham({0, 0}, {to.y, to.x});
    for (Cell& cell : mirrored) {
      cell.x = -cell.x;
    }
    for (Cell& cell : transposed) {
      std::swap(cell.x, cell.y);
    }
    ASSERT_EQ(words(mirrored), words(cells));
    ASSERT_EQ(words(transposed), words(cells));
  }
}

// Bresenham 1965, of two equally near cells: the one further on.
TEST(Bresenham, StepsAsideWhereBothAreEquallyNear) {
  EXPECT_EQ(words(cells_bresenham({0, 0}, {2, 1})), "(0 0)(1 1)(2 1)");
  EXPECT_EQ(words(cells_bresenham({0, 0}, {0, 0})), "(0 0)");
}

}  // namespace
}  // namespace iog::lab::reference
