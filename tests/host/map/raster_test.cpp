// Polygons to bits, against the crossings of each row by themselves, and by laws.
#include "map/raster.hpp"

#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "map/flat_map.hpp"

namespace iog::map {
namespace {

void take(Raster& raster, FinePoint from, FinePoint to) {
  if (const RowRange rows = raster.crossed(from.y, to.y); !rows.is_empty()) {
    raster.add_edge(rows, from, to);
  }
}

FrameBits drawn(const std::vector<FineRing>& rings, RowRange rows = {}) {
  Raster raster;
  raster.clear(rows);
  for (const FineRing& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      take(raster, ring[i], ring[(i + 1) % ring.size()]);
    }
  }
  FrameBits bits;
  raster.add_to(bits);
  return bits;
}

std::uint32_t count(const FrameBits& bits) {
  std::uint32_t cells = 0;
  for (const std::uint64_t row : bits.rows) {
    cells += static_cast<std::uint32_t>(std::popcount(row));
  }
  return cells;
}

void expect_inside(const std::vector<FineRing>& rings) {
  const FrameBits bits = drawn(rings);
  for (std::int32_t row = 0; row < kFrameSide; ++row) {
    for (std::int32_t column = 0; column < kFrameSide; ++column) {
      ASSERT_EQ(has(bits, column, row), is_inside(rings, centre(column, row)))
          << column << ' ' << row;
    }
  }
}

// Within so many fine units of the frame, or on a lattice of half cells, so that centres are
// vertices and lie on edges.
FinePoint somewhere(tests::Random& random, std::int32_t around) {
  const FinePoint point{random.between(-around, kFrameSide * kFine + around),
                        random.between(-around, kFrameSide * kFine + around)};
  constexpr std::int32_t kHalf = kFine / 2;
  return random.one_in(2) ? point : FinePoint{point.x / kHalf * kHalf, point.y / kHalf * kHalf};
}

FineRing ring(tests::Random& random, std::int32_t around) {
  FineRing ring;
  for (std::size_t i = 0; i < 3 + random.below(6); ++i) {
    ring.push_back(somewhere(random, around));
  }
  return ring;
}

TEST(Raster, CellsAreInsideByTheCrossingsOfTheirRow) {
  tests::Random random(1);
  for (const std::int32_t around : {0, 100, 20'000, 3'000'000, 500'000'000}) {
    for (int i = 0; i < tests::effort(400, 8); ++i) {
      std::vector<FineRing> rings{ring(random, around)};
      if (random.one_in(2)) {
        rings.push_back(ring(random, around));  // a hole, or beside it, or across
      }
      expect_inside(rings);
    }
  }
}

// Coordinates as far apart as the largest map's.
TEST(Raster, EdgesMayBeAsLongAsTheLargestMap) {
  constexpr std::int32_t kFar = (1 << 30) - 20'000;
  tests::Random random(2);
  for (int i = 0; i < tests::effort(2000, 40); ++i) {
    const auto far = [&random] {
      return FinePoint{random.between(-kFar, kFar), random.between(-kFar, kFar)};
    };
    expect_inside({{far(), far(), somewhere(random, 0)}});
    expect_inside({{{-kFar, -kFar}, {kFar, kFar}, {kFar, -kFar}}});
  }
}

TEST(Raster, SliversAreAsWideAsTheCentresTheyHold) {
  tests::Random random(3);
  for (int i = 0; i < tests::effort(1000, 20); ++i) {
    const FinePoint from = somewhere(random, 3000);
    const FinePoint to = somewhere(random, 3000);
    expect_inside({{from, to, {to.x + random.between(-2, 2), to.y + random.between(-2, 2)}}});
  }
}

// 64 by 64 cells by borders at centres: the lower and the left one belong to the polygon.
TEST(Raster, LowerAndLeftBordersAreInside) {
  const FinePoint low = centre(10, 20);
  const FinePoint high = centre(13, 22);
  const FrameBits bits = drawn({{low, {high.x, low.y}, high, {low.x, high.y}}});
  EXPECT_EQ(count(bits), 3U * 2);
  EXPECT_TRUE(has(bits, 10, 20));
  EXPECT_TRUE(has(bits, 12, 21));
}

// A square is cut along a way from its left to its right side; each cell is in one part.
TEST(Raster, PolygonsThatShareAnEdgeShareNoCellAndLeaveNoneOut) {
  tests::Random random(4);
  constexpr std::int32_t kSide = kFrameSide * kFine;
  for (int i = 0; i < tests::effort(1000, 20); ++i) {
    FineRing way{{0, random.between(0, kSide)}};
    for (std::size_t more = random.below(8); more > 0; --more) {
      way.push_back(somewhere(random, 0));
    }
    way.push_back({kSide, random.between(0, kSide)});
    FineRing below = way;
    below.insert(below.end(), {{kSide, 0}, {0, 0}});
    FineRing above = way;
    above.insert(above.end(), {{kSide, kSide}, {0, kSide}});
    const FrameBits a = drawn({below});
    const FrameBits b = drawn({above});
    for (std::size_t row = 0; row < kFrameSide; ++row) {
      ASSERT_EQ(a.rows[row] ^ b.rows[row], ~std::uint64_t{0});
    }
  }
}

TEST(Raster, NoOrderAndNoDirectionOfEdgesShows) {
  tests::Random random(5);
  for (int i = 0; i < tests::effort(300, 10); ++i) {
    const FineRing points = ring(random, 1000);
    std::vector<std::pair<FinePoint, FinePoint>> edges;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const FinePoint to = points[(k + 1) % points.size()];
      edges.insert(edges.begin() + static_cast<std::ptrdiff_t>(random.below(edges.size() + 1)),
                   random.one_in(2) ? std::pair(points[k], to) : std::pair(to, points[k]));
    }
    Raster raster;
    raster.clear({});
    for (const auto& [from, to] : edges) {
      take(raster, from, to);
    }
    FrameBits bits;
    raster.add_to(bits);
    ASSERT_EQ(bits.rows, drawn({points}).rows);
  }
}

TEST(Raster, PolygonsAreUnited) {
  tests::Random random(6);
  for (int i = 0; i < tests::effort(300, 10); ++i) {
    const FineRing one = ring(random, 1000);
    const FineRing other = ring(random, 1000);
    Raster raster;
    raster.clear({});
    FrameBits bits;
    for (const FineRing& points : {one, other}) {
      for (std::size_t k = 0; k < points.size(); ++k) {
        take(raster, points[k], points[(k + 1) % points.size()]);
      }
      raster.add_to(bits);
    }
    const FrameBits a = drawn({one});
    const FrameBits b = drawn({other});
    for (std::size_t row = 0; row < kFrameSide; ++row) {
      ASSERT_EQ(bits.rows[row], a.rows[row] | b.rows[row]);
    }
  }
}

TEST(Raster, RowsAndColumnsThatAreNotAskedForCostNothingAndChangeNoOther) {
  tests::Random random(7);
  for (std::int32_t cells = 0; cells <= kHalo; ++cells) {
    const RowRange rows = RowRange::around_tile(cells);
    const FineRing points = ring(random, 20'000);
    const FrameBits all = drawn({points});
    const FrameBits some = drawn({points}, rows);
    const std::int32_t side = 32 + 2 * cells;
    const std::uint64_t columns = (side == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << side) - 1)
                                  << (kHalo - cells);
    for (std::int32_t row = 0; row < kFrameSide; ++row) {
      const bool is_asked = row >= kHalo - cells && row < kHalo + 32 + cells;
      ASSERT_EQ(some.rows[static_cast<std::size_t>(row)] & (is_asked ? columns : ~std::uint64_t{0}),
                is_asked ? all.rows[static_cast<std::size_t>(row)] & columns : 0);
    }
  }
}

}  // namespace
}  // namespace iog::map
